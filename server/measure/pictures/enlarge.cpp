#include "measure/pictures/enlarge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace grove::measure {
namespace {

/// The two source texels of one output pixel along one axis, and the second one's weight.
struct Tap {
  std::size_t first = 0;
  std::size_t second = 0;
  double weight = 0.0;
};

Tap tapOf(int pixel, int size, int sourceSize) {
  const double place = (pixel + 0.5) * sourceSize / size - 0.5;
  const int first = static_cast<int>(std::floor(place));
  const auto inside = [&](int texel) { return static_cast<std::size_t>(std::clamp(texel, 0, sourceSize - 1)); };
  return {inside(first), inside(first + 1), place - first};
}

double byteOf(std::uint32_t pixel, unsigned shift) { return static_cast<double>((pixel >> shift) & 0xFFU); }

}  // namespace

std::vector<std::uint32_t> enlarged(const Picture& picture, int width, int height) {
  const auto stride = static_cast<std::size_t>(picture.width);
  std::vector<std::uint32_t> out;
  out.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const Tap down = tapOf(y, height, picture.height());
    const auto rowOf = [&](std::size_t row) { return picture.colour.subspan(row * stride, stride); };
    const auto upper = rowOf(down.first);
    const auto lower = rowOf(down.second);
    for (int x = 0; x < width; ++x) {
      const Tap across = tapOf(x, width, picture.width);
      std::uint32_t pixel = 0;
      for (const unsigned shift : {0U, 8U, 16U, 24U}) {
        const auto between = [&](std::span<const std::uint32_t> row) {
          return std::lerp(byteOf(row[across.first], shift), byteOf(row[across.second], shift), across.weight);
        };
        const double byte = std::lerp(between(upper), between(lower), down.weight);
        pixel |= static_cast<std::uint32_t>(std::lround(byte)) << shift;
      }
      out.push_back(pixel);
    }
  }
  return out;
}

}  // namespace grove::measure
