#pragma once

#include "world/sky.h"

namespace grove::objects::sky {

/// The effect of clouds on the sky behind them: result = sky * (1 - cover) + light.
struct CloudSample {
  world::Vec3 light{0.0F};
  float cover = 0.0F;
};

/// Soft evening clouds in two layers, lit by a low sun from the side: glowing rims towards the sun, mauve undersides
/// away from it. `direction` is a unit vector.
[[nodiscard]] CloudSample cloudsAt(const world::Sky& sky, world::Vec3 direction, float seed);

}  // namespace grove::objects::sky
