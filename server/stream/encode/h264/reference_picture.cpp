#include "stream/encode/h264/reference_picture.h"

#include <algorithm>

namespace grove::stream::h264 {
namespace {

/// A cache line; luma rows begin at one, because their border is that wide.
constexpr std::ptrdiff_t kLine = 64;

BorderedPlane planeOf(int width, int height, int border) {
  BorderedPlane plane{width, height, border, (width + 2 * border + kLine - 1) / kLine * kLine};
  plane.bytes.resize(static_cast<std::size_t>(plane.stride) * static_cast<std::size_t>(height + 2 * border));
  return plane;
}

void extendPlane(BorderedPlane& plane, int top, int bottom) {
  for (int y = top; y < bottom; ++y) {
    std::fill_n(plane.at(-plane.border, y), plane.border, *plane.at(0, y));
    std::fill_n(plane.at(plane.width, y), plane.border, *plane.at(plane.width - 1, y));
  }
  const auto copyRow = [&](int from, int to) {
    std::copy_n(plane.at(-plane.border, from), plane.width + 2 * plane.border, plane.at(-plane.border, to));
  };
  if (top == 0) {
    for (int y = -plane.border; y < 0; ++y) copyRow(0, y);
  }
  if (bottom == plane.height) {
    for (int y = plane.height; y < plane.height + plane.border; ++y) copyRow(plane.height - 1, y);
  }
}

}  // namespace

ReferencePicture::ReferencePicture(int macroblocksAcross, int macroblocksDown)
    : planes_{planeOf(kMacroblock * macroblocksAcross, kMacroblock * macroblocksDown, kBorder),
              planeOf(kMacroblock / 2 * macroblocksAcross, kMacroblock / 2 * macroblocksDown, kBorder / 2),
              planeOf(kMacroblock / 2 * macroblocksAcross, kMacroblock / 2 * macroblocksDown, kBorder / 2)} {}

void ReferencePicture::extend(int top, int bottom) {
  extendPlane(planes_[0], top, bottom);
  extendPlane(planes_[1], top / 2, bottom / 2);
  extendPlane(planes_[2], top / 2, bottom / 2);
}

std::size_t ReferencePicture::bytes() const noexcept {
  return planes_[0].bytes.size() + planes_[1].bytes.size() + planes_[2].bytes.size();
}

}  // namespace grove::stream::h264
