#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>

#include "cli/bench/picture_size.h"
#include "cli/bench/walk/walk_world.h"
#include "world/walk.h"

namespace grove::cli {

/// Returns the bytes of memory that drawing and encoding one frame touches, an upper bound in whole pages, see
/// measure::touchedBytes(): the median of some frames spread over the walk, with simulations at rest. Returns nothing
/// if the kernel cannot report it, or after a stop request.
[[nodiscard]] std::optional<std::int64_t> measureViewMemory(WalkWorld& world, const world::Walk& walk, double seconds,
                                                            const PictureSize& size, const std::stop_token& stop);

}  // namespace grove::cli
