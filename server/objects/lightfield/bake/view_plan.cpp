#include "objects/lightfield/bake/view_plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "models/plants/plants.h"
#include "objects/lightfield/bake/directions.h"

namespace grove::bake {

using objects::lightfield::ObjectCamera;
using objects::lightfield::ViewGeometry;
using world::Vec3;

namespace {

constexpr int kOnSphere = 16;
constexpr int kOffSphere = 8;
constexpr std::size_t kBox = 64;      // points
constexpr float kRounding = 1.0e-3F;  // metres

/// The farthest points in many directions: their ball is nearly the ball around all points.
std::vector<Vec3> outermost(const std::vector<Vec3>& points) {
  const std::vector<Vec3> directions = evenDirections(160);
  std::vector<float> max(directions.size(), -std::numeric_limits<float>::infinity());
  std::vector<Vec3> farthest(directions.size(), Vec3(0.0F));
  // Adjacent points are close together: few boxes of them have to be searched.
  for (std::size_t first = 0; first < points.size(); first += kBox) {
    const std::span box = std::span(points).subspan(first, std::min(kBox, points.size() - first));
    world::Bounds bounds;
    for (const Vec3 point : box) bounds.add(point);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const Vec3 direction = directions[i];
      const float reach = glm::dot(bounds.centre(), direction) + 0.5F * glm::dot(bounds.size(), glm::abs(direction));
      if (reach < max[i] - kRounding) continue;
      for (const Vec3 point : box) {
        const float along = glm::dot(point, direction);
        if (along <= max[i]) continue;
        max[i] = along;
        farthest[i] = point;
      }
    }
  }
  return farthest;
}

/// Moves towards the farthest point in shrinking steps (M. Badoiu and K. Clarkson, "Smaller core-sets for balls",
/// 2003).
Vec3 centreOfBall(const std::vector<Vec3>& points) {
  constexpr int kSteps = 2000;
  Vec3 centre = points.front();
  for (int step = 1; step <= kSteps; ++step) {
    Vec3 farthest = centre;
    float max = -1.0F;
    for (const Vec3 point : points) {
      const float squared = glm::dot(point - centre, point - centre);
      if (squared > max) {
        max = squared;
        farthest = point;
      }
    }
    centre += (farthest - centre) / static_cast<float>(step + 1);
  }
  return centre;
}

float farthestFrom(Vec3 centre, const std::vector<Vec3>& points) {
  float max = 0.0F;
  for (const Vec3 point : points) max = std::max(max, glm::dot(point - centre, point - centre));
  return std::sqrt(max);
}

Vec3 latticeDirection(float i, float j, float n) {
  const float u = i / n;
  const float v = j / n;
  return glm::normalize(Vec3(u, std::max(0.0F, 1.0F - std::abs(u) - std::abs(v)), v));
}

/// The middle of a direction's cell in the views' lattice.
Vec3 amidViews(Vec3 direction, int subdivision) {
  const auto n = static_cast<float>(subdivision);
  const float sum = std::abs(direction.x) + direction.y + std::abs(direction.z);
  const float i = std::abs(direction.x) / sum * n;
  const float j = std::abs(direction.z) / sum * n;
  const float left = std::min(std::floor(i), n - 1.0F);
  const float top = std::min(std::floor(j), n - 1.0F - left);
  // Cells at the rim are triangles, half a cell.
  const float inner = left + top + 2.0F > n ? 1.0F / 3.0F : 0.5F;
  return latticeDirection(std::copysign(left + inner, direction.x), std::copysign(top + inner, direction.z), n);
}

}  // namespace

ViewGeometry planViews(const world::Triangles& triangles) {
  const world::Bounds bounds = triangles.bounds();
  ViewGeometry geometry;
  geometry.centre = {bounds.centre().x, 0.0F, bounds.centre().z};
  geometry.target = centreOfBall(outermost(triangles.positions));
  // A margin, so that the outermost pixels are complete.
  geometry.extent = std::max(farthestFrom(geometry.target, triangles.positions) * 1.01F, 1.0e-3F);
  geometry.radius = 2.0F * std::max(farthestFrom(geometry.centre, triangles.positions), 1.0e-3F);
  return geometry;
}

std::vector<ObjectCamera> planHeldOut(const ViewGeometry& geometry, int subdivision, int size) {
  // The spiral's upper half, from the top to the horizon.
  const std::vector<Vec3> around = evenDirections(2 * kOnSphere);
  std::vector<ObjectCamera> cameras;
  for (int i = 0; i < kOnSphere; ++i) {
    const Vec3 direction = amidViews(around[static_cast<std::size_t>(i)], subdivision);
    cameras.push_back(objectCamera(viewCamera(geometry, direction), size));
  }
  const std::vector<Vec3> others = evenDirections(2 * kOffSphere);
  for (int i = 0; i < kOffSphere; ++i) {
    ViewGeometry moved = geometry;
    moved.radius *= 0.8F + 0.8F * static_cast<float>((i * 3) % kOffSphere) / static_cast<float>(kOffSphere - 1);
    cameras.push_back(objectCamera(viewCamera(moved, others[static_cast<std::size_t>(i)]), size));
  }
  return cameras;
}

std::vector<ObjectCamera> planSeams(const ViewGeometry& geometry, int size) {
  constexpr int kEdges = 6;
  constexpr float kTurn = 1.0471976F;
  std::vector<ObjectCamera> cameras;
  for (int edge = 0; edge < kEdges; ++edge) {
    const float outwards = (static_cast<float>(edge) + 0.5F) * kTurn;
    ViewGeometry aimed = geometry;
    aimed.target = 0.8660254F * models::kTileRadius * Vec3(std::cos(outwards), 0.0F, std::sin(outwards));
    aimed.centre = aimed.target;
    // From along the edge to across it, and from steep to flat.
    const float around = outwards + 0.7F * static_cast<float>(edge);
    const float up = 0.25F + 0.15F * static_cast<float>(edge);
    const Vec3 direction(std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around));
    cameras.push_back(objectCamera(viewCamera(aimed, direction), size));
  }
  return cameras;
}

}  // namespace grove::bake
