#pragma once

#include <array>

#include "world/players.h"

namespace grove::objects::figure {

/// How a visitor is built.
struct Stature {
  float height = 1.0F;   ///< what the figure is to be scaled by
  float breadth = 1.0F;  ///< of body and cloak, in times of the usual
};
inline constexpr std::array<Stature, 3> kStatures{Stature{1.0F, 1.0F}, Stature{1.05F, 0.93F}, Stature{0.92F, 1.1F}};

/// Which of kStatures a visitor has.
[[nodiscard]] constexpr std::size_t statureOf(world::PlayerId player) { return player % kStatures.size(); }

/// From the ground to the tip of the hood of a figure of the usual height. Metres.
inline constexpr float kFigureHeight = 1.82F;

}  // namespace grove::objects::figure
