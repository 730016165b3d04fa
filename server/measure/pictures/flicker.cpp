#include "measure/pictures/flicker.h"

#include <algorithm>
#include <cassert>

namespace grove::measure {
namespace {

/// Returns the mean luma of the block with this upper left pixel.
double blockLuma(const Picture& picture, int left, int top) {
  const int right = std::min(left + Flicker::kBlock, picture.width);
  const int bottom = std::min(top + Flicker::kBlock, picture.height());
  std::array<std::uint32_t, 3> sums{};
  for (int y = top; y < bottom; ++y) {
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
    for (int x = left; x < right; ++x) {
      const std::uint32_t pixel = picture.colour[row + static_cast<std::size_t>(x)];
      sums[0] += pixel & 0xFFU;
      sums[1] += (pixel >> 8U) & 0xFFU;
      sums[2] += (pixel >> 16U) & 0xFFU;
    }
  }
  return lumaOf(sums[0], sums[1], sums[2]) / ((right - left) * (bottom - top));
}

/// Returns whether the middle value differs from both others in the same direction.
bool jumps(double before, double middle, double after) {
  const double up = middle - std::max(before, after);
  const double down = std::min(before, after) - middle;
  return std::max(up, down) > Flicker::kThreshold;
}

}  // namespace

void Flicker::add(const Picture& picture) {
  std::rotate(means_.begin(), means_.begin() + 1, means_.end());
  std::vector<double>& means = means_.back();
  means.clear();
  for (int y = 0; y < picture.height(); y += kBlock) {
    for (int x = 0; x < picture.width; x += kBlock) means.push_back(blockLuma(picture, x, y));
  }
  if (++pictures_ < means_.size()) return;
  assert(means.size() == means_[0].size() && means.size() == means_[1].size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (jumps(means_[0][i], means_[1][i], means[i])) ++jumps_;
  }
  blocks_ += means.size();
}

double Flicker::share() const noexcept {
  return blocks_ > 0 ? static_cast<double>(jumps_) / static_cast<double>(blocks_) : 0.0;
}

}  // namespace grove::measure
