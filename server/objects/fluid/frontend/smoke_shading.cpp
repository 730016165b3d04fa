#include "objects/fluid/frontend/smoke_shading.h"

#include <cmath>

namespace grove::objects::fluid {

using world::Vec3;

SmokeShading::SmokeShading() {
  for (std::size_t i = 0; i <= kDisplaySteps; ++i) {
    const float root = static_cast<float>(i) / static_cast<float>(kDisplaySteps);
    display_[i] = world::toDisplay(kBrightestSmoke * root * root);
  }
}

void SmokeShading::shade(const FluidSnapshot& snapshot, const world::Camera& camera,
                         std::span<const world::PointLight> lights, const SmokeDetail& detail, double time,
                         SmokeSprites& sprites) const {
  const Vec3 sky = 0.75F * world::ambient({0.0F, 1.0F, 0.0F}) + 0.25F * world::ambient({0.0F, -1.0F, 0.0F});
  scatterSunAndSky(snapshot, camera.pose.position, world::sunDirection(), world::sunColour(), sky, sprites);
  for (const world::PointLight& light : lights) addPointLight(snapshot, light, sprites);
  finishSprites(snapshot, detail.kept, static_cast<float>(std::fmod(time, 1000.0)), display_.data(), sprites);
}

}  // namespace grove::objects::fluid
