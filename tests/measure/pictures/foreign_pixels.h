#pragma once

#include <cstddef>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// Minimum distance, of 255, of a foreign pixel's channel from the reference's range around it: compression and other
/// blades of the same grass stay below.
inline constexpr int kForeignContrast = 32;
/// Pixels to each side: half of the maximum width of a gap in reprojected pictures.
inline constexpr int kForeignReach = 8;

/// Counts pixels whose colour the reference, of the same size, does not have within kForeignReach: some channel is
/// below the minimum or above the maximum there by more than kForeignContrast. So ground that shows through a gap among
/// plants counts, and so does a plant in front of bare ground; small movements and mixtures of nearby colours do not.
[[nodiscard]] std::size_t foreignPixels(const Picture& shown, const Picture& reference);

}  // namespace grove::measure
