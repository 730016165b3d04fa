#pragma once

#include <cstddef>

#include "measure/pictures/picture_quality.h"

namespace grove::measure {

/// By how much, of 255, a channel of a foreign pixel is beyond all that the reference has around it: compression and
/// other blades of the same grass stay below.
inline constexpr int kForeignContrast = 32;
/// Pixels to each side: half of the width of a gap that moved pictures may open.
inline constexpr int kForeignReach = 8;

/// Pixels of a picture in colours that the reference, of the same size, does not have within kForeignReach: in some
/// channel less than the least there or more than the greatest, by more than kForeignContrast. So ground that shows
/// through a gap among plants counts, and so does a plant before bare ground; what moved a little, or is a mixture of
/// what is there, does not.
[[nodiscard]] std::size_t foreignPixels(const Picture& shown, const Picture& reference);

}  // namespace grove::measure
