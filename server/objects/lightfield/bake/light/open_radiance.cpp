#include "objects/lightfield/bake/light/open_radiance.h"

#include <cstddef>

#include "objects/lightfield/bake/directions.h"

namespace grove::bake {

using world::Vec3;

std::vector<Vec3> openRadiance(std::span<const Vec3> directions, const Lightings& lightings) {
  const auto count = static_cast<std::size_t>(lightings.count());
  std::vector<Vec3> sums(directions.size() * count, Vec3(0.0F));
  std::vector<float> parts(directions.size(), 0.0F);
  for (const Vec3 fine : evenDirections(16384)) {
    if (fine.y <= 0.0F) continue;
    std::size_t nearest = 0;
    for (std::size_t d = 1; d < directions.size(); ++d) {
      if (glm::dot(directions[d], fine) > glm::dot(directions[nearest], fine)) nearest = d;
    }
    parts[nearest] += 1.0F;
    for (std::size_t k = 0; k < count; ++k) {
      sums[nearest * count + k] += lightings.skyRadiance(static_cast<int>(k), fine);
    }
  }
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (std::size_t k = 0; k < count; ++k) {
      Vec3& sum = sums[d * count + k];
      sum = directions[d].y > 0.0F ? sum / parts[d] : lightings.meadowRadiance();
    }
  }
  return sums;
}

}  // namespace grove::bake
