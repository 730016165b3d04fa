#pragma once

#include "world/geometry.h"

namespace grove::objects::sky {

/// What clouds do to the sky behind them: result = sky * (1 - cover) + light.
struct CloudSample {
  world::Vec3 light{0.0F};
  float cover = 0.0F;
};

/// Soft evening clouds in two layers, lit by the low sun from the side: glowing rims towards it, mauve bellies away
/// from it. A pure function of the direction (unit vector) and the seed.
[[nodiscard]] CloudSample cloudsAt(world::Vec3 direction, float seed);

}  // namespace grove::objects::sky
