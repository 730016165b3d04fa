#include "raster/soften.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace grove::raster {
namespace {

/// Three neighbouring rows of an image, softened or widened across: row y is in slot y % 3.
template <class Pixel>
class Rows {
 public:
  explicit Rows(int width) {
    for (std::vector<Pixel>& row : rows_) row.resize(static_cast<std::size_t>(width));
  }
  [[nodiscard]] Pixel* of(int y) { return rows_[static_cast<std::size_t>(y) % rows_.size()].data(); }

 private:
  std::array<std::vector<Pixel>, 3> rows_;
};

}  // namespace

void soften(Image& image, Softening softening) {
  assert(image.spans.empty());
  if (image.rect.empty()) return;
  const int width = image.width();
  const int last = image.height() - 1;
  Rows<std::uint32_t> colours(width);
  Rows<float> depths(width);
  const auto read = [&](int y) {
    softenAcross(image.colourRow(y), width, softening, colours.of(y));
    nearestAcross(image.depthRow(y), width, depths.of(y));
  };
  read(0);
  for (int y = 0; y <= last; ++y) {
    if (y < last) read(y + 1);
    const int above = std::max(y - 1, 0);
    const int below = std::min(y + 1, last);
    softenDown(colours.of(above), colours.of(y), colours.of(below), width, softening, image.colourRow(y));
    deepenFringe(depths.of(above), depths.of(y), depths.of(below), image.colourRow(y), width, image.depthRow(y));
  }
}

}  // namespace grove::raster
