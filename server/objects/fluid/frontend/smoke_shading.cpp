#include "objects/fluid/frontend/smoke_shading.h"

#include <cmath>

namespace grove::objects::fluid {
namespace {

SmokeSky skyOver(const world::Sky& sky) {
  const world::Vec3 level = glm::normalize(world::Vec3(sky.sun.x, 0.0F, sky.sun.z));
  return {.above = 0.3F * sky.ambient({0.0F, 1.0F, 0.0F}) + 0.1F * sky.ambient({0.0F, -1.0F, 0.0F}),
          .side = 0.3F * (sky.ambient(level) + sky.ambient(-level))};
}

}  // namespace

SmokeShading::SmokeShading(const world::Sky& sky) : sun_(sky.sun), sunColour_(sky.sunColour), sky_(skyOver(sky)) {
  for (std::size_t i = 0; i <= kDisplaySteps; ++i) {
    const float root = static_cast<float>(i) / static_cast<float>(kDisplaySteps);
    display_[i] = world::toDisplay(kBrightestSmoke * root * root);
  }
}

void SmokeShading::shade(const FluidSnapshot& snapshot, const world::Camera& camera,
                         std::span<const world::PointLight> lights, const SmokeDetail& detail, double time,
                         SmokeSprites& sprites) const {
  scatterSunAndSky(snapshot, camera.pose.position, sun_, sunColour_, sky_, sprites);
  for (const world::PointLight& light : lights) addPointLight(snapshot, light, sprites);
  finishSprites(snapshot, detail.kept, static_cast<float>(std::fmod(time, 1000.0)), display_.data(), sprites);
}

}  // namespace grove::objects::fluid
