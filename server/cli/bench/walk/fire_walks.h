#pragma once

#include "world/layout.h"
#include "world/walk.h"

namespace grove::cli {

/// Around the fire at a walk, looking about: at the fire, ahead, and over to the trees. What benches walk that are
/// given no file; its name is kRoundWalkName.
[[nodiscard]] world::Walk roundWalk(const world::Layout& layout);
inline constexpr const char* kRoundWalkName = "around the fire";

/// Before the fire, without a step.
[[nodiscard]] world::Walk standingWalk(const world::Layout& layout);

}  // namespace grove::cli
