#pragma once

#include <stop_token>

#include "cli/bench/encode/kept_frames.h"
#include "cli/bench/picture_size.h"
#include "cli/bench/walk/walk_world.h"
#include "world/walk.h"

namespace grove::cli {

/// Records the frames along the walk, 30 per second. After a stop request, returns the frames so far.
[[nodiscard]] KeptFrames recordWalk(WalkWorld& world, const world::Walk& walk, double seconds, const PictureSize& size,
                                    const std::stop_token& stop);

}  // namespace grove::cli
