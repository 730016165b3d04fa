#pragma once

#include <array>

#include "world/object.h"
#include "world/players.h"

namespace grove::objects::figure {

/// A visitor's build.
struct Stature {
  float height = 1.0F;   ///< scale of the whole figure
  float breadth = 1.0F;  ///< of body and cloak, relative to the usual
};
inline constexpr std::array<Stature, 3> kStatures{Stature{1.0F, 1.0F}, Stature{1.05F, 0.93F}, Stature{0.92F, 1.1F}};

/// Index of a visitor's build in kStatures.
[[nodiscard]] constexpr std::size_t statureOf(world::PlayerId player) { return player % kStatures.size(); }

/// Metres of a visitor's figure per metre of the unscaled one.
[[nodiscard]] inline float scaleOf(const world::Object& object) {
  return object.transform.scale * kStatures[statureOf(object.id - world::kFirstPlayerObject)].height;
}

/// Height of the unscaled figure, to the tip of the hood. Metres.
inline constexpr float kFigureHeight = 1.82F;

}  // namespace grove::objects::figure
