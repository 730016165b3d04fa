#pragma once

#include <stop_token>

#include "cli/bench/encode/kept_frames.h"
#include "cli/bench/picture_size.h"
#include "cli/bench/walk/walk_world.h"
#include "world/walk.h"

namespace grove::cli {

/// What he sees who goes along the walk, thirty frames a second. If it is to stop, returns what there is.
[[nodiscard]] KeptFrames recordWalk(WalkWorld& world, const world::Walk& walk, double seconds, const PictureSize& size,
                                    const std::stop_token& stop);

}  // namespace grove::cli
