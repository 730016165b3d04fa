#pragma once

#include <array>
#include <cstdint>

#include "raster/drawing.h"

namespace grove::objects::figure {

/// What each bone moves.
enum Bone : std::uint8_t { kBody, kLeftLeg, kRightLeg, kArm };

/// How a visitor is built. Its height is left to who places it.
struct Stature {
  float height = 1.0F;   ///< what the figure is to be scaled by
  float breadth = 1.0F;  ///< of body and cloak, in times of the usual
};
inline constexpr std::array<Stature, 3> kStatures{Stature{1.0F, 1.0F}, Stature{1.05F, 0.93F}, Stature{0.92F, 1.1F}};

/// A hooded visitor with a lantern, feet at the origin, looking along -Z. Cloak and lantern take the drawing's tint.
[[nodiscard]] raster::LitSurface makeFigure(float breadth);

/// What a visitor sees of himself: his boots.
[[nodiscard]] raster::LitSurface makeOwnFigure();

}  // namespace grove::objects::figure
