#pragma once

#include "world/layout.h"
#include "world/walk.h"

namespace grove::cli {

/// A walk around the fire, with views of the fire, ahead, and of the trees: the default walk of benches, named
/// kRoundWalkName.
[[nodiscard]] world::Walk roundWalk(const world::Layout& layout);
inline constexpr const char* kRoundWalkName = "around the fire";

/// Stands still in front of the fire.
[[nodiscard]] world::Walk standingWalk(const world::Layout& layout);

}  // namespace grove::cli
