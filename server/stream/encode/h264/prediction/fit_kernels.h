#pragma once

#include "stream/encode/h264/macroblock_pixels.h"

namespace grove::stream::h264 {

/// How far luma is to be moved, so that the prediction fits the source best: a least-squares step by the prediction's
/// gradients, in pixels, to be added to the vector (B. Lucas and T. Kanade, IJCAI 1981). Zero where gradients do not
/// tell.
struct Offset {
  float x;
  float y;
};
[[nodiscard]] Offset offsetOf(const MacroblockPixels& source, const MacroblockPixels& prediction);

}  // namespace grove::stream::h264
