#include "world/geometry.h"

#include <cmath>

namespace grove::world {

std::array<Vec3, 8> Bounds::corners() const noexcept {
  std::array<Vec3, 8> result;
  for (unsigned i = 0; i < 8; ++i) {
    result[i] = {(i & 1U) ? high.x : low.x, (i & 2U) ? high.y : low.y, (i & 4U) ? high.z : low.z};
  }
  return result;
}

void Bounds::add(Vec3 point) noexcept {
  low = glm::min(low, point);
  high = glm::max(high, point);
}

void Bounds::add(const Bounds& other) noexcept {
  low = glm::min(low, other.low);
  high = glm::max(high, other.high);
}

Mat4 Transform::matrix() const {
  Mat4 moved = glm::translate(Mat4(1.0F), position);
  moved[0].y = slope.x;
  moved[2].y = slope.y;
  return glm::scale(glm::rotate(moved, yaw, Vec3(0, 1, 0)), Vec3(scale));
}

Bounds Transform::apply(const Bounds& bounds) const {
  Bounds result;
  if (bounds.empty()) return result;
  const Mat4 m = matrix();
  for (const Vec3 corner : bounds.corners()) result.add(Vec3(m * Vec4(corner, 1.0F)));
  return result;
}

void Triangles::append(const Triangles& other, const Mat4& matrix) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  for (const Vec3 p : other.positions) positions.emplace_back(matrix * Vec4(p, 1.0F));
  for (const auto& [a, b, c] : other.indices) indices.push_back({a + first, b + first, c + first});
}

Bounds Triangles::bounds() const {
  Bounds result;
  for (const Vec3 p : positions) result.add(p);
  return result;
}

glm::mat3 basisAround(Vec3 n) noexcept {
  const float sign = std::copysign(1.0F, n.z);
  const float a = -1.0F / (sign + n.z);
  const float b = n.x * n.y * a;
  return {Vec3(1.0F + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3(b, sign + n.y * n.y * a, -n.y), n};
}

}  // namespace grove::world
