#include "measure/pictures/dark_gaps.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace grove::measure {
namespace {

double lumaAt(const Picture& picture, std::size_t pixel) {
  const std::uint32_t colour = picture.colour[pixel];
  return lumaOf(colour & 0xFFU, (colour >> 8U) & 0xFFU, (colour >> 16U) & 0xFFU);
}

/// Returns whether the picture is brighter than a dark gap everywhere around the pixel.
bool isBrightAround(const Picture& picture, int x, int y) {
  const int right = std::min(x + kDarkGapReach, picture.width - 1);
  const int bottom = std::min(y + kDarkGapReach, picture.height() - 1);
  for (int row = std::max(y - kDarkGapReach, 0); row <= bottom; ++row) {
    for (int column = std::max(x - kDarkGapReach, 0); column <= right; ++column) {
      const auto pixel =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(column);
      if (lumaAt(picture, pixel) < kNearBlack + kDarkGapContrast) return false;
    }
  }
  return true;
}

}  // namespace

std::size_t darkGaps(const Picture& shown, const Picture& reference) {
  assert(shown.width == reference.width && shown.colour.size() == reference.colour.size());
  std::size_t gaps = 0;
  std::size_t pixel = 0;
  for (int y = 0; y < shown.height(); ++y) {
    for (int x = 0; x < shown.width; ++x, ++pixel) {
      if (lumaAt(shown, pixel) < kNearBlack && isBrightAround(reference, x, y)) ++gaps;
    }
  }
  return gaps;
}

}  // namespace grove::measure
