#pragma once

#include <span>

#include "objects/ground/frontend/relief/ground_row.h"
#include "world/ground/hills.h"

namespace grove::objects::ground {

/// Kernel: finds where the rays of a row meet the ground, on the strip that begins at `firstColumn`. Searches from the
/// depths of the next nearer row on, because ground that a nearer row shows hides what is behind it. `nearer` may be
/// `out`; a strip's first row has none (null).
void findGround(const Frame& frame, std::span<const world::Hill> hills, int row, int firstColumn,
                const GroundRow* nearer, GroundRow& out);

}  // namespace grove::objects::ground
