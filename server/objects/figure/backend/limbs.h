#pragma once

#include "raster/surface.h"

/// A figure's legs and arms, and the lantern that it carries, feet at the origin, looking along -Z.
namespace grove::objects::figure {

inline constexpr float kHipHeight = 0.8F;  ///< metres, where the legs turn
inline constexpr float kShoulderHeight = 1.34F;

/// In a boot, up to `length` metres. `side`: -1 left, 1 right.
[[nodiscard]] raster::Surface makeLeg(float side, float length);
/// Bent before the chest.
[[nodiscard]] raster::Surface makeLeftArm();
/// Holds the lantern.
[[nodiscard]] raster::Surface makeRightArm();
[[nodiscard]] raster::Surface makeLantern();

}  // namespace grove::objects::figure
