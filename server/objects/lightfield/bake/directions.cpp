#include "objects/lightfield/bake/directions.h"

#include <cmath>

namespace grove::bake {

using world::Vec3;

std::vector<Vec3> evenDirections(int count) {
  constexpr float kGoldenAngle = 2.3999632F;
  std::vector<Vec3> directions;
  directions.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(count);
    const float radius = std::sqrt(1.0F - y * y);
    const float angle = kGoldenAngle * static_cast<float>(i);
    directions.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
  }
  return directions;
}

glm::mat3 basisAround(Vec3 n) noexcept {
  const float sign = std::copysign(1.0F, n.z);
  const float a = -1.0F / (sign + n.z);
  const float b = n.x * n.y * a;
  return {Vec3(1.0F + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3(b, sign + n.y * n.y * a, -n.y), n};
}

}  // namespace grove::bake
