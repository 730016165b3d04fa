#pragma once

#include <array>

#include "stream/encode/h264/macroblock_pixels.h"
#include "stream/encode/h264/reference_picture.h"
#include "stream/encode/motion_vector.h"

namespace grove::stream::h264 {

// Kernels: predict a macroblock from the reference, an 8 x 8 block of luma per vector, row by row (ITU-T H.264, section
// 8.4.2.2). Blocks may reach beyond the picture by ReferencePicture::kBorder - 3 pixels.

/// Returns how far the prediction is from the source: the sum of absolute differences.
[[nodiscard]] int predictLuma(const ReferencePicture& reference, int column, int row,
                              const std::array<MotionVector, 4>& vectors, const MacroblockPixels& source,
                              MacroblockPixels& to);
void predictChroma(const ReferencePicture& reference, int column, int row, const std::array<MotionVector, 4>& vectors,
                   MacroblockPixels& to);

}  // namespace grove::stream::h264
