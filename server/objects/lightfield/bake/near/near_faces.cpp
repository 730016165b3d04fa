#include "objects/lightfield/bake/near/near_faces.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace grove::bake {

using world::Vec3;

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Cosine of the largest angle between two triangles of a face.
constexpr float kFlat = 0.95F;

/// Cosine of the largest angle between the normals at a convex quadrilateral's corners.
constexpr float kConvex = 0.5F;

/// The quadrilateral of two triangles with a common edge.
std::optional<std::array<std::uint32_t, 4>> joined(const Corners& a, const Corners& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (a[i] != b[(k + 1) % 3] || a[(i + 1) % 3] != b[k]) continue;
      return std::array{a[i], b[(k + 2) % 3], a[(i + 1) % 3], a[(i + 2) % 3]};
    }
  }
  return std::nullopt;
}

bool isFlatAndConvex(const std::array<std::uint32_t, 4>& corners, const std::vector<Vec3>& positions) {
  std::array<Vec3, 4> normals;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 at = positions[corners[i]];
    const Vec3 normal = glm::cross(positions[corners[(i + 1) % 4]] - at, positions[corners[(i + 3) % 4]] - at);
    const float length = glm::length(normal);
    if (length <= 0.0F) return false;
    normals[i] = normal / length;
  }
  // Those at the second and last corner are the normals of the two triangles.
  return glm::dot(normals[1], normals[3]) >= kFlat && glm::dot(normals[0], normals[1]) >= kConvex &&
         glm::dot(normals[2], normals[1]) >= kConvex;
}

}  // namespace

std::vector<ModelFace> facesOf(const models::Model& model) {
  const std::vector<Corners>& triangles = model.triangles.indices;
  std::vector<ModelFace> faces;
  faces.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Corners& a = triangles[i];
    const std::uint16_t material = model.materialOf[i];
    if (i + 1 < triangles.size() && model.materialOf[i + 1] == material) {
      const auto corners = joined(a, triangles[i + 1]);
      if (corners && isFlatAndConvex(*corners, model.triangles.positions)) {
        faces.push_back({*corners, material});
        ++i;
        continue;
      }
    }
    faces.push_back({{a[0], a[1], a[2], a[2]}, material});
  }
  return faces;
}

}  // namespace grove::bake
