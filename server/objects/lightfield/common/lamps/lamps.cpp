#include "objects/lightfield/common/lamps/lamps.h"

#include "world/strongest_lights.h"

namespace grove::objects::lightfield {

std::vector<world::PointLight> chooseLamps(std::span<const world::PointLight> lights, const world::Bounds& worldBounds,
                                           const world::Mat4& toObject) {
  const auto nearness = [&](const world::PointLight& light) {
    return -glm::distance(light.position, glm::clamp(light.position, worldBounds.low, worldBounds.high));
  };
  std::vector<world::PointLight> near = world::strongestLights(lights, kMaxLamps, -kLampReach, nearness);
  for (world::PointLight& light : near) light.position = world::Vec3(toObject * world::Vec4(light.position, 1.0F));
  return near;
}

}  // namespace grove::objects::lightfield
