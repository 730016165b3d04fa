#pragma once

#include "stream/encode/h264/macroblock_pixels.h"
#include "stream/encode/h264/prediction/intra_prediction.h"
#include "stream/encode/h264/reference_picture.h"

namespace grove::stream::h264 {

/// A mode and how far its prediction is from a macroblock: the sum of absolute differences of luma.
struct IntraFit {
  IntraMode mode;
  int difference;
};

/// Kernel: the possible mode that fits best. Finds the differences without storing predictions. `enough`: the
/// difference of another prediction; where intra prediction is unlikely to be better, not all modes are tried.
[[nodiscard]] IntraFit bestIntraLuma(const ReferencePicture& picture, int column, int row,
                                     const MacroblockPixels& source, int enough);

}  // namespace grove::stream::h264
