#pragma once

#include <cstdint>

#include "raster/drawing.h"

namespace grove::objects::figure {

/// Groups of vertices that move together.
enum Bone : std::uint8_t { kBody, kLeftLeg, kRightLeg, kArm, kBones };

/// Makes a hooded visitor with a lantern, kFigureHeight tall, feet at the origin, facing -Z. Cloak and lantern take the
/// drawing's tint.
[[nodiscard]] raster::LitSurface makeFigure(float breadth);

/// Makes the visible part of a visitor's own figure: the boots.
[[nodiscard]] raster::LitSurface makeOwnFigure();

}  // namespace grove::objects::figure
