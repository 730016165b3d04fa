#pragma once

#include <array>

#include "stream/encode/h264/macroblock.h"
#include "stream/encode/motion_vector.h"

namespace grove::stream::h264 {

// What a decoder expects of vectors, from those of earlier macroblocks (ITU-T H.264, section 8.4.1).

/// The vector of a whole macroblock.
[[nodiscard]] MotionVector expectedVector(const MacroblockGrid& grid, int column, int row);

/// The vector of an 8 x 8 block; `vectors` has those before it.
[[nodiscard]] MotionVector expectedVector(const MacroblockGrid& grid, int column, int row, int block,
                                          const std::array<MotionVector, 4>& vectors);

/// The vector of a skipped macroblock. `expected`: that of a whole one.
[[nodiscard]] MotionVector skippedVector(const MacroblockGrid& grid, int column, int row, const MotionVector& expected);

}  // namespace grove::stream::h264
