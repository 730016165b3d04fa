#include "objects/lightfield/common/cached_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "objects/lightfield/common/cached_view_kernels.h"

namespace grove::objects::lightfield {
namespace {

/// The covered part of an image, in its own rows and columns.
struct Covered {
  world::Rect part;
  float nearest = world::kInfiniteDepth;
};

Covered coveredPart(const raster::Image& image) {
  Covered covered{{image.width(), image.height(), 0, 0}};
  world::Rect& part = covered.part;
  for (int y = 0; y < image.height(); ++y) {
    const CoveredSpan span = coveredSpan(image.colourRow(y), image.depthRow(y), image.width());
    if (span.end <= span.begin) continue;
    part.left = std::min(part.left, span.begin);
    part.right = std::max(part.right, span.end);
    part.top = std::min(part.top, y);
    part.bottom = y + 1;
    covered.nearest = std::min(covered.nearest, span.nearest);
  }
  return covered;
}

}  // namespace

CachedView::CachedView(const raster::Image& image, const ObjectCamera& camera) : camera_(camera) {
  const auto [part, nearest] = coveredPart(image);
  if (part.empty()) return;
  left_ = image.rect.left + part.left - kBorder;
  top_ = image.rect.top + part.top - kBorder;
  width_ = part.width() + 2 * kBorder;
  height_ = part.height() + 2 * kBorder;
  allocate();
  // A power of two: subtracting and adding it causes little rounding.
  softness_ = std::bit_cast<float>((std::bit_cast<std::uint32_t>(1.0F / nearest) & 0x7F800000U) + 0x00800000U);
  copy(image);
  spread();
  measure();
}

void CachedView::allocate() {
  colour_ = std::make_unique_for_overwrite<std::uint32_t[]>(texels() + padding());
  nearness_ = std::make_unique_for_overwrite<float[]>(texels() + padding());
  std::fill_n(colour_.get() + texels(), padding(), 0U);
  std::fill_n(nearness_.get() + texels(), padding(), 0.0F);
}

std::size_t CachedView::ownBytes() const noexcept {
  return sizeof(*this) + (texels() + padding()) * (sizeof(std::uint32_t) + sizeof(float)) +
         ranges_.capacity() * sizeof(Range);
}

/// Copies colour and 1 / depth, 0 where empty. Not a kernel, because 1 / depth must be exact.
void CachedView::copy(const raster::Image& image) {
  for (int y = 0; y < height_; ++y) {
    std::uint32_t* const colour = colour_.get() + std::ptrdiff_t{y} * width_;
    float* const nearness = nearness_.get() + std::ptrdiff_t{y} * width_;
    std::fill_n(colour, width_, 0U);
    std::fill_n(nearness, width_, 0.0F);
    if (y < kBorder || y >= height_ - kBorder) continue;
    const int row = y + top_ - image.rect.top;
    const int column = left_ + kBorder - image.rect.left;
    const std::uint32_t* const fromColour = image.colourRow(row) + column;
    const float* const fromDepth = image.depthRow(row) + column;
    for (int x = 0; x < width_ - 2 * kBorder; ++x) {
      const bool covered = showsAnything(fromColour[x], fromDepth[x]);
      const float near = 1.0F / fromDepth[x];
      colour[x + kBorder] = covered ? fromColour[x] : 0U;
      nearness[x + kBorder] = covered ? near : 0.0F;
    }
  }
}

/// Gives empty texels beside covered ones the nearest of their depths, and marks those that hide nothing.
void CachedView::spread() {
  const auto width = static_cast<std::size_t>(width_);
  std::array<std::vector<float>, 3> wide{std::vector<float>(width), std::vector<float>(width),
                                         std::vector<float>(width)};
  const auto widen = [&](int y) {
    widenRow(nearness_.get() + std::ptrdiff_t{y} * width_, width_, wide[static_cast<std::size_t>(y) % 3].data());
  };
  widen(0);
  widen(1);
  const auto wideRow = [&](int row) { return wide[static_cast<std::size_t>(row) % 3].data(); };
  for (int y = 0; y < height_; ++y) {
    if (y > 0 && y + 1 < height_) widen(y + 1);
    rankRow(wideRow(std::max(y - 1, 0)), wideRow(y), wideRow(std::min(y + 1, height_ - 1)),
            colour_.get() + std::ptrdiff_t{y} * width_, width_, softness_,
            nearness_.get() + std::ptrdiff_t{y} * width_);
  }
}

void CachedView::measure() {
  constexpr float kNever = 1.0e30F;
  const auto width = static_cast<std::size_t>(width_);
  std::vector<float> min(width);
  std::vector<float> max(width);
  ranges_.reserve(static_cast<std::size_t>(squaresAcross()) * static_cast<std::size_t>(squaresDown()));
  whole_ = {kNever, 0.0F};
  for (int top = 0; top < height_; top += kSquare) {
    std::fill(min.begin(), min.end(), kNever);
    std::fill(max.begin(), max.end(), 0.0F);
    for (int y = top; y < std::min(top + kSquare, height_); ++y) {
      widenRanges(nearness_.get() + std::ptrdiff_t{y} * width_, width_, softness_, min.data(), max.data());
    }
    for (std::size_t left = 0; left < width; left += kSquare) {
      Range range{kNever, 0.0F};
      for (std::size_t x = left; x < std::min(left + kSquare, width); ++x) {
        range.min = std::min(range.min, min[x]);
        range.max = std::max(range.max, max[x]);
      }
      ranges_.push_back(range);
      whole_.min = std::min(whole_.min, range.min);
      whole_.max = std::max(whole_.max, range.max);
    }
  }
}

}  // namespace grove::objects::lightfield
