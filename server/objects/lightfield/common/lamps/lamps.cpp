#include "objects/lightfield/common/lamps/lamps.h"

#include <algorithm>

namespace grove::objects::lightfield {

std::vector<world::PointLight> chooseLamps(std::span<const world::PointLight> lights, const world::Bounds& worldBounds,
                                           const world::Mat4& toObject) {
  std::vector<world::PointLight> near;
  const auto distance = [&](const world::PointLight& light) {
    return glm::distance(light.position, glm::clamp(light.position, worldBounds.low, worldBounds.high));
  };
  for (const world::PointLight& light : lights) {
    if (distance(light) < kLampReach) near.push_back(light);
  }
  std::ranges::sort(near, {}, distance);
  near.resize(std::min(near.size(), kMaxLamps));
  for (world::PointLight& light : near) light.position = world::Vec3(toObject * world::Vec4(light.position, 1.0F));
  return near;
}

}  // namespace grove::objects::lightfield
