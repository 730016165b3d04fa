#pragma once

#include "stream/encode/h264/macroblock_pixels.h"

namespace grove::stream::h264 {

/// The variance of a macroblock's luma.
[[nodiscard]] float varianceOf(const MacroblockPixels& pixels);

}  // namespace grove::stream::h264
