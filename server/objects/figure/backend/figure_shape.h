#pragma once

#include "raster/drawing.h"

namespace grove::objects::figure {

/// What each bone moves.
enum Bone : std::uint8_t { kBody, kLeftLeg, kRightLeg, kArm };

inline constexpr float kHipHeight = 0.8F;  ///< metres, where the legs turn
inline constexpr float kShoulderHeight = 1.28F;

/// A hooded visitor with a lantern, feet at the origin, looking along -Z. Cloak and lantern take the drawing's tint.
[[nodiscard]] raster::LitSurface makeFigure();

}  // namespace grove::objects::figure
