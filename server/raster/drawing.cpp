#include "raster/drawing.h"

#include <algorithm>

#include "world/strongest_lights.h"

namespace grove::raster {
namespace {

/// A lamp that adds less than this to a white surface is invisible.
constexpr float kFaintest = 0.002F;

float strongest(const world::PointLight& light, const world::Bounds& bounds) {
  const world::Vec3 nearest = glm::clamp(light.position, bounds.low, bounds.high);
  const world::Vec3 away = light.position - nearest;
  return std::max({light.colour.r, light.colour.g, light.colour.b}) / (glm::dot(away, away) + 0.02F);
}

}  // namespace

Lamps chooseLamps(std::span<const world::PointLight> lights, const world::Bounds& bounds) {
  const std::vector<world::PointLight> chosen = world::strongestLights(
      lights, kMaxLamps, kFaintest, [&](const world::PointLight& light) { return strongest(light, bounds); });
  Lamps lamps;
  lamps.count = static_cast<int>(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    lamps.position[i] = chosen[i].position;
    lamps.colour[i] = chosen[i].colour;
  }
  return lamps;
}

}  // namespace grove::raster
