#pragma once

#include <cstddef>
#include <stop_token>

#include "cli/bench/encode/kept_frames.h"
#include "cli/bench/walk/walk_world.h"
#include "cli/bench/warp/bench_warp.h"
#include "stream/adapt/border_choice.h"
#include "world/walk.h"

namespace grove::cli {

/// Of half the window: what the server adds over slow lines.
inline constexpr int kWarpBorderPercent = stream::BorderChoice::kMaxPercent;

/// The frames of a walk that a page shows.
struct SentWalk {
  KeptFrames truth;  ///< from where the visitor is, for each frame of the display
  KeptFrames sent;   ///< from where the server expects them to be when the picture comes
  std::size_t step;  ///< frames of the display for each sent one
};

/// Draws them, in real time if the machine can. Throws EnvironmentError if the disk is full.
[[nodiscard]] SentWalk drawSentWalk(WalkWorld& world, const world::Walk& walk, const BenchWarpOptions& options,
                                    const std::stop_token& stop);

}  // namespace grove::cli
