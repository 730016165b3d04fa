#pragma once

#include <cstdint>

#include "raster/drawing.h"

namespace grove::objects::figure {

/// What each bone moves.
enum Bone : std::uint8_t { kBody, kLeftLeg, kRightLeg, kArm };

/// A hooded visitor with a lantern, kFigureHeight tall, feet at the origin, looking along -Z. Cloak and lantern take
/// the drawing's tint.
[[nodiscard]] raster::LitSurface makeFigure(float breadth);

/// What a visitor sees of himself: his boots.
[[nodiscard]] raster::LitSurface makeOwnFigure();

}  // namespace grove::objects::figure
