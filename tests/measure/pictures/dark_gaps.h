#pragma once

#include <cstddef>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// Luma of 255 below which a pixel is near-black.
inline constexpr double kNearBlack = 12.0;
/// Minimum difference by which the reference is brighter around a dark gap; less is a rounding error of dark content.
inline constexpr double kDarkGapContrast = 4.0;
/// Pixels to each side: half of the maximum width of a gap in reprojected pictures.
inline constexpr int kDarkGapReach = 8;

/// Counts near-black pixels of a picture where the reference, of the same size, has nothing as dark within
/// kDarkGapReach.
[[nodiscard]] std::size_t darkGaps(const Picture& shown, const Picture& reference);

}  // namespace grove::measure
