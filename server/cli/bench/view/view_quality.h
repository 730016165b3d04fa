#pragma once

#include <optional>
#include <stop_token>

#include "cli/bench/picture_size.h"
#include "cli/bench/walk/walk_world.h"
#include "world/walk.h"

namespace grove::cli {

/// Compares a visitor's frames with frames in which everything is drawn.
struct ViewQuality {
  double meanDecibels = 0.0;   ///< PSNR of the mean square error over all frames
  double worstDecibels = 0.0;  ///< PSNR of the worst frame
  double flicker = 0.0;        ///< of the visitor's frames, see measure::Flicker
  double flickerReference = 0.0;
};

/// Two visitors draw each frame of the walk at the same moment. What changes between the two, such as smoke whose next
/// state arrives, is noise of the measurement. Returns nothing if it is stopped before the first frame.
[[nodiscard]] std::optional<ViewQuality> measureViewQuality(WalkWorld& world, const world::Walk& walk, double seconds,
                                                            const PictureSize& size, const std::stop_token& stop);

}  // namespace grove::cli
