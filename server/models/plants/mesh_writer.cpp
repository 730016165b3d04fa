#include "models/plants/mesh_writer.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace grove::models {

using world::Vec3;

namespace {

/// Rotates counter-clockwise as seen from above.
class TurnAboutY {
 public:
  explicit TurnAboutY(float radians) : cosine_(std::cos(radians)), sine_(std::sin(radians)) {}

  Vec3 operator()(Vec3 v) const { return {cosine_ * v.x + sine_ * v.z, v.y, cosine_ * v.z - sine_ * v.x}; }

 private:
  const float cosine_;
  const float sine_;
};

}  // namespace

std::uint16_t MeshWriter::addMaterial(Material material) {
  model_.materials.push_back(std::move(material));
  return static_cast<std::uint16_t>(model_.materials.size() - 1);
}

std::uint32_t MeshWriter::vertex(Vec3 position, Vec3 colour) {
  model_.triangles.positions.push_back(position);
  model_.colours.push_back(colour);
  return static_cast<std::uint32_t>(model_.triangles.positions.size() - 1);
}

void MeshWriter::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint16_t material) {
  assert(material < model_.materials.size());
  model_.triangles.indices.push_back({a, b, c});
  model_.materialOf.push_back(material);
}

void MeshWriter::finishSurface() {
  const auto& positions = model_.triangles.positions;
  const auto& indices = model_.triangles.indices;
  const std::size_t first = model_.normals.size();
  model_.normals.resize(positions.size(), Vec3(0.0F));
  for (auto at = indices.rbegin(); at != indices.rend() && (*at)[0] >= first; ++at) {
    const auto [a, b, c] = *at;
    const Vec3 doubleArea = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    for (const auto corner : *at) model_.normals[corner] += doubleArea;
  }
  for (std::size_t i = first; i < positions.size(); ++i) model_.normals[i] = unitOr(model_.normals[i], Vec3(0, 1, 0));
}

MeshWriter::Mark MeshWriter::mark() const {
  return {model_.triangles.positions.size(), model_.triangles.indices.size()};
}

void MeshWriter::takeBack(Mark mark) {
  model_.triangles.positions.resize(mark.vertices);
  model_.normals.resize(mark.vertices);
  model_.colours.resize(mark.vertices);
  model_.triangles.indices.resize(mark.triangles);
  model_.materialOf.resize(mark.triangles);
}

void MeshWriter::repeatTurned(Mark from, Mark to, float radians) {
  const TurnAboutY turn(radians);
  const auto shift = static_cast<std::uint32_t>(model_.triangles.positions.size() - from.vertices);
  for (std::size_t i = from.vertices; i < to.vertices; ++i) {
    vertex(turn(model_.triangles.positions[i]), Vec3(model_.colours[i]));
    model_.normals.push_back(turn(model_.normals[i]));
  }
  for (std::size_t i = from.triangles; i < to.triangles; ++i) {
    const auto [a, b, c] = model_.triangles.indices[i];
    triangle(a + shift, b + shift, c + shift, model_.materialOf[i]);
  }
}

void MeshWriter::add(const Model& other, const Placement& placement, std::uint16_t firstMaterial) {
  const TurnAboutY turn(placement.radians);
  const auto first = static_cast<std::uint32_t>(model_.triangles.positions.size());
  for (std::size_t i = 0; i < other.triangles.positions.size(); ++i) {
    vertex(placement.position + placement.scale * turn(other.triangles.positions[i]),
           other.colours[i] * placement.tint);
    model_.normals.push_back(turn(other.normals[i]));
  }
  for (std::size_t i = 0; i < other.triangles.indices.size(); ++i) {
    const auto [a, b, c] = other.triangles.indices[i];
    triangle(a + first, b + first, c + first, static_cast<std::uint16_t>(firstMaterial + other.materialOf[i]));
  }
}

Vec3 unitOr(Vec3 v, Vec3 otherwise) noexcept {
  const float length = glm::length(v);
  return length > 1.0e-20F ? v / length : otherwise;
}

Vec3 anyNormalTo(Vec3 direction) noexcept {
  const Vec3 other = std::abs(direction.y) < 0.8F ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
  return glm::normalize(glm::cross(direction, other));
}

Vec3 turned(Vec3 v, Vec3 axis, float radians) noexcept {
  const float cosine = std::cos(radians);
  const float sine = std::sin(radians);
  return v * cosine + glm::cross(axis, v) * sine + axis * (glm::dot(axis, v) * (1.0F - cosine));
}

}  // namespace grove::models
