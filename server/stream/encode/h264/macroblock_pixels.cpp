#include "stream/encode/h264/macroblock_pixels.h"

#include <algorithm>
#include <cstring>

namespace grove::stream::h264 {
namespace {

/// Copies a square of pixels to rows that are kStride apart.
template <int kSide>
void readSquare(const std::uint8_t* plane, int width, int height, int left, int top, std::uint8_t* to) {
  const int columns = std::min(kSide, width - left);
  if (columns == kSide && top + kSide <= height) {
    const std::uint8_t* from = plane + std::ptrdiff_t{top} * width + left;
    for (int y = 0; y < kSide; ++y, from += width) std::memcpy(to + y * MacroblockPixels::kStride, from, kSide);
    return;
  }
  for (int y = 0; y < kSide; ++y) {
    const std::uint8_t* const from = plane + std::ptrdiff_t{std::min(top + y, height - 1)} * width + left;
    std::uint8_t* const row = to + y * MacroblockPixels::kStride;
    if (columns == kSide) {
      std::memcpy(row, from, kSide);
    } else {
      std::copy_n(from, columns, row);
      std::fill_n(row + columns, kSide - columns, from[columns - 1]);
    }
  }
}

}  // namespace

void readMacroblock(const raster::YuvImage& image, int column, int row, MacroblockPixels& to) {
  const int left = column * kMacroblock;
  const int top = row * kMacroblock;
  const int width = image.width();
  const int height = image.height();
  readSquare<16>(image.y(), width, height, left, top, to.luma.data());
  readSquare<8>(image.u(), width / 2, height / 2, left / 2, top / 2, to.chroma.data());
  readSquare<8>(image.v(), width / 2, height / 2, left / 2, top / 2, to.chroma.data() + 8);
}

void writeLuma(const MacroblockPixels& pixels, int column, int row, ReferencePicture& to) {
  for (int y = 0; y < kMacroblock; ++y) {
    const std::uint8_t* const from = pixels.luma.data() + y * MacroblockPixels::kStride;
    std::memcpy(to.plane(0).at(column * kMacroblock, row * kMacroblock + y), from, 16);
  }
}

void writeChroma(const MacroblockPixels& pixels, int column, int row, ReferencePicture& to) {
  for (int y = 0; y < kMacroblock / 2; ++y) {
    const std::uint8_t* const from = pixels.chroma.data() + y * MacroblockPixels::kStride;
    std::memcpy(to.plane(1).at(column * 8, row * 8 + y), from, 8);
    std::memcpy(to.plane(2).at(column * 8, row * 8 + y), from + 8, 8);
  }
}

}  // namespace grove::stream::h264
