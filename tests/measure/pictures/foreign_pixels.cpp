#include "measure/pictures/foreign_pixels.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

namespace grove::measure {
namespace {

/// Minimum and maximum of red, green and blue.
struct ColourRange {
  std::array<int, 3> min{255, 255, 255};
  std::array<int, 3> max{0, 0, 0};

  void add(const ColourRange& other) {
    for (std::size_t i = 0; i < min.size(); ++i) {
      min[i] = std::min(min[i], other.min[i]);
      max[i] = std::max(max[i], other.max[i]);
    }
  }
};

std::array<int, 3> channelsOf(std::uint32_t colour) {
  return {static_cast<int>(colour & 0xFFU), static_cast<int>((colour >> 8U) & 0xFFU),
          static_cast<int>((colour >> 16U) & 0xFFU)};
}

/// Computes the ranges within kForeignReach along a line of `count` pixels that are `stride` apart.
void widen(const ColourRange* from, ColourRange* to, int count, std::ptrdiff_t stride) {
  for (int i = 0; i < count; ++i) {
    ColourRange range;
    const int last = std::min(i + kForeignReach, count - 1);
    for (int j = std::max(i - kForeignReach, 0); j <= last; ++j) range.add(from[j * stride]);
    to[i * stride] = range;
  }
}

/// Returns the range of the square around each pixel.
std::vector<ColourRange> rangesAround(const Picture& picture) {
  std::vector<ColourRange> ranges(picture.colour.size());
  std::ranges::transform(picture.colour, ranges.begin(), [](std::uint32_t colour) {
    const auto channels = channelsOf(colour);
    return ColourRange{channels, channels};
  });
  std::vector<ColourRange> wide(ranges.size());
  const std::ptrdiff_t width = picture.width;
  for (int y = 0; y < picture.height(); ++y) widen(&ranges[0] + y * width, &wide[0] + y * width, picture.width, 1);
  for (int x = 0; x < picture.width; ++x) widen(&wide[0] + x, &ranges[0] + x, picture.height(), width);
  return ranges;
}

bool isForeign(const std::array<int, 3>& channels, const ColourRange& range) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i] < range.min[i] - kForeignContrast || channels[i] > range.max[i] + kForeignContrast) return true;
  }
  return false;
}

}  // namespace

std::size_t foreignPixels(const Picture& shown, const Picture& reference) {
  assert(shown.width == reference.width && shown.colour.size() == reference.colour.size());
  if (shown.colour.empty()) return 0;
  const std::vector<ColourRange> ranges = rangesAround(reference);
  std::size_t foreign = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (isForeign(channelsOf(shown.colour[i]), ranges[i])) ++foreign;
  }
  return foreign;
}

}  // namespace grove::measure
