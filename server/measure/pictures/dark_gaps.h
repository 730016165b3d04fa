#pragma once

#include <cstddef>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// Luma of 255 below which a pixel is near-black.
inline constexpr double kNearBlack = 12.0;
/// How much brighter the reference is around a dark gap: less is a rounding error of what is dark anyway.
inline constexpr double kDarkGapContrast = 4.0;
/// Pixels to each side: half of the width of a gap that moved pictures may open.
inline constexpr int kDarkGapReach = 8;

/// Near-black pixels of a picture where the reference, of the same size, shows nothing as dark within kDarkGapReach.
[[nodiscard]] std::size_t darkGaps(const Picture& shown, const Picture& reference);

}  // namespace grove::measure
