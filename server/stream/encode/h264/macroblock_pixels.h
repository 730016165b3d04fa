#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raster/yuv_image.h"
#include "stream/encode/h264/macroblock.h"
#include "stream/encode/h264/reference_picture.h"

namespace grove::stream::h264 {

/// The pixels of a macroblock: of the source, or as predicted.
struct MacroblockPixels {
  /// Bytes from one row to the next, in both.
  static constexpr std::ptrdiff_t kStride = kMacroblock;

  alignas(64) std::array<std::uint8_t, 256> luma;
  alignas(64) std::array<std::uint8_t, 128> chroma;  ///< rows of 8 values of U, then 8 of V
};

/// Reads a macroblock. One that reaches beyond the image repeats its last column and row there.
void readMacroblock(const raster::YuvImage& image, int column, int row, MacroblockPixels& to);

/// Write pixels as they are predicted.
void writeLuma(const MacroblockPixels& pixels, int column, int row, ReferencePicture& to);
void writeChroma(const MacroblockPixels& pixels, int column, int row, ReferencePicture& to);

}  // namespace grove::stream::h264
