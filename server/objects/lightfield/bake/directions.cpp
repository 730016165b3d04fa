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

}  // namespace grove::bake
