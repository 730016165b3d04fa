#pragma once

#include "raster/surface.h"

/// A figure's legs, arms and lantern, feet at the origin, facing -Z.
namespace grove::objects::figure {

inline constexpr float kHipHeight = 0.8F;  ///< metres, pivot of the legs
inline constexpr float kShoulderHeight = 1.34F;

/// A leg in a boot, up to `length` metres. `side`: -1 left, 1 right.
[[nodiscard]] raster::Surface makeLeg(float side, float length);
/// The arm bent in front of the chest.
[[nodiscard]] raster::Surface makeLeftArm();
/// The arm that holds the lantern.
[[nodiscard]] raster::Surface makeRightArm();
[[nodiscard]] raster::Surface makeLantern();

}  // namespace grove::objects::figure
