#include "objects/lightfield/cache/cached_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace grove::objects::lightfield {
namespace {

// A node::Image's "nothing" is kInfiniteDepth.
constexpr float kFarthest = 0.5F * world::kInfiniteDepth;

bool shows(std::uint32_t colour, float depth) { return (depth < kFarthest) & (colour >> 24U != 0); }

/// Of the covered pixels, in the image's own rows and columns.
world::Rect coveredPart(const node::Image& image) {
  world::Rect part{image.width(), image.height(), 0, 0};
  for (int y = 0; y < image.height(); ++y) {
    const std::uint32_t* __restrict colour = image.colourRow(y);
    const float* __restrict depth = image.depthRow(y);
    int first = image.width();
    int last = -1;
    for (int x = 0; x < image.width(); ++x) {
      const bool covered = shows(colour[x], depth[x]);
      first = std::min(first, covered ? x : image.width());
      last = std::max(last, covered ? x : -1);
    }
    if (last < 0) continue;
    part.left = std::min(part.left, first);
    part.right = std::max(part.right, last + 1);
    part.top = std::min(part.top, y);
    part.bottom = y + 1;
  }
  return part;
}

/// Every column's range, with one more row.
void widenRanges(const float* __restrict nearness, int width, float softness, float* __restrict least,
                 float* __restrict greatest) {
  for (int x = 0; x < width; ++x) {
    const float near = nearness[x] < 0.0F ? nearness[x] + softness : nearness[x];
    least[x] = near > 0.0F ? std::min(least[x], near) : least[x];
    greatest[x] = std::max(greatest[x], near);
  }
}

}  // namespace

CachedView::CachedView(const node::Image& image, const ObjectCamera& camera) : camera_(camera) {
  const world::Rect part = coveredPart(image);
  if (part.empty()) return;
  left_ = image.rect.left + part.left - kBorder;
  top_ = image.rect.top + part.top - kBorder;
  width_ = part.width() + 2 * kBorder;
  height_ = part.height() + 2 * kBorder;
  colour_ = std::make_unique_for_overwrite<std::uint32_t[]>(texels());
  nearness_ = std::make_unique_for_overwrite<float[]>(texels());
  copy(image);
  spread();
  measure();
}

std::size_t CachedView::bytes() const noexcept {
  return sizeof(*this) + texels() * (sizeof(std::uint32_t) + sizeof(float)) + ranges_.capacity() * sizeof(Range);
}

/// Colour and 1 / depth, 0 where there is nothing.
void CachedView::copy(const node::Image& image) {
  float greatest = 0.0F;
  for (int y = 0; y < height_; ++y) {
    std::uint32_t* __restrict colour = colour_.get() + std::ptrdiff_t{y} * width_;
    float* __restrict nearness = nearness_.get() + std::ptrdiff_t{y} * width_;
    std::fill_n(colour, width_, 0U);
    std::fill_n(nearness, width_, 0.0F);
    if (y < kBorder || y >= height_ - kBorder) continue;
    const int row = y + top_ - image.rect.top;
    const int column = left_ + kBorder - image.rect.left;
    const std::uint32_t* __restrict fromColour = image.colourRow(row) + column;
    const float* __restrict fromDepth = image.depthRow(row) + column;
    for (int x = 0; x < width_ - 2 * kBorder; ++x) {
      const bool covered = shows(fromColour[x], fromDepth[x]);
      const float near = covered ? 1.0F / fromDepth[x] : 0.0F;
      colour[x + kBorder] = covered ? fromColour[x] : 0U;
      nearness[x + kBorder] = near;
      greatest = std::max(greatest, near);
    }
  }
  // A power of two: it can be taken away and added again with little rounding.
  softness_ = std::bit_cast<float>((std::bit_cast<std::uint32_t>(greatest) & 0x7F800000U) + 0x00800000U);
}

/// Gives empty texels beside covered ones the nearest of their depths, and marks those that hide nothing.
void CachedView::spread() {
  const auto width = static_cast<std::size_t>(width_);
  std::array<std::vector<float>, 3> wide{std::vector<float>(width), std::vector<float>(width),
                                         std::vector<float>(width)};
  const auto widen = [&](int y) {
    const float* __restrict near = nearness_.get() + std::ptrdiff_t{y} * width_;
    float* __restrict out = wide[static_cast<std::size_t>(y) % 3].data();
    for (int x = 1; x < width_ - 1; ++x) out[x] = std::max(std::max(near[x - 1], near[x]), near[x + 1]);
  };
  widen(0);
  widen(1);
  const float softness = softness_;
  for (int y = 0; y < height_; ++y) {
    if (y > 0 && y + 1 < height_) widen(y + 1);
    const float* __restrict above = wide[static_cast<std::size_t>(std::max(y - 1, 0)) % 3].data();
    const float* __restrict here = wide[static_cast<std::size_t>(y) % 3].data();
    const float* __restrict below = wide[static_cast<std::size_t>(std::min(y + 1, height_ - 1)) % 3].data();
    const std::uint32_t* __restrict colour = colour_.get() + std::ptrdiff_t{y} * width_;
    float* __restrict near = nearness_.get() + std::ptrdiff_t{y} * width_;
    for (int x = 0; x < width_; ++x) {
      const float around = std::max(std::max(above[x], here[x]), below[x]);
      const float own = near[x] > 0.0F ? near[x] : around;
      near[x] = colour[x] >> 24U >= 128U ? own : own - softness;
    }
  }
}

void CachedView::measure() {
  constexpr float kNever = 1.0e30F;
  const auto width = static_cast<std::size_t>(width_);
  std::vector<float> least(width);
  std::vector<float> greatest(width);
  ranges_.reserve(static_cast<std::size_t>(squaresAcross()) * static_cast<std::size_t>(squaresDown()));
  whole_ = {kNever, 0.0F};
  for (int top = 0; top < height_; top += kSquare) {
    std::fill(least.begin(), least.end(), kNever);
    std::fill(greatest.begin(), greatest.end(), 0.0F);
    for (int y = top; y < std::min(top + kSquare, height_); ++y) {
      widenRanges(nearness_.get() + std::ptrdiff_t{y} * width_, width_, softness_, least.data(), greatest.data());
    }
    for (std::size_t left = 0; left < width; left += kSquare) {
      Range range{kNever, 0.0F};
      for (std::size_t x = left; x < std::min(left + kSquare, width); ++x) {
        range.least = std::min(range.least, least[x]);
        range.greatest = std::max(range.greatest, greatest[x]);
      }
      ranges_.push_back(range);
      whole_.least = std::min(whole_.least, range.least);
      whole_.greatest = std::max(whole_.greatest, range.greatest);
    }
  }
}

}  // namespace grove::objects::lightfield
