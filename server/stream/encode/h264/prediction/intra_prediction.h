#pragma once

#include <cstdint>

#include "stream/encode/h264/macroblock_pixels.h"
#include "stream/encode/h264/reference_picture.h"

namespace grove::stream::h264 {

/// How an intra macroblock is predicted from the pixels around it. The numbers are those of Intra16x16PredMode.
enum class IntraMode : std::uint8_t { kVertical = 0, kHorizontal = 1, kMean = 2, kPlane = 3 };

/// Whether the pixels that a mode needs are within the picture.
[[nodiscard]] bool isPossible(IntraMode mode, int column, int row);

/// Predicts luma from the unfiltered pixels left of and above the macroblock (ITU-T H.264, section 8.3.3).
void predictIntraLuma(const ReferencePicture& picture, int column, int row, IntraMode mode, MacroblockPixels& to);
/// Predicts chroma (section 8.3.4).
void predictIntraChroma(const ReferencePicture& picture, int column, int row, IntraMode mode, MacroblockPixels& to);

/// intra_chroma_pred_mode of a mode.
[[nodiscard]] std::uint32_t chromaModeNumber(IntraMode mode);

}  // namespace grove::stream::h264
