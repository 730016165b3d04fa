#pragma once

#include <cstdint>

#include "world/camera.h"

namespace grove::objects::lightfield {

/// Whether a raster::Image's pixel is covered; empty pixels have kInfiniteDepth.
[[nodiscard]] constexpr bool showsAnything(std::uint32_t colour, float depth) noexcept {
  return (depth < 0.5F * world::kInfiniteDepth) & (colour >> 24U != 0);
}

/// Covered columns of a row of pixels, from `begin` to before `end`; none if end <= begin.
struct CoveredSpan {
  int begin = 0;
  int end = 0;
  float nearest = world::kInfiniteDepth;  ///< depth
};

/// Finds the covered columns of a raster::Image's row.
[[nodiscard]] CoveredSpan coveredSpan(const std::uint32_t* colour, const float* depth, int width);

/// The max of each value and its two neighbours, except at the ends.
void widenRow(const float* near, int width, float* wide);

/// Makes one row of CachedView::nearness() from 1 / depth and from the widened rows above, here and below.
void rankRow(const float* above, const float* here, const float* below, const std::uint32_t* colour, int width,
             float softness, float* nearness);

/// Extends each column's range of 1 / depth by a row of CachedView::nearness().
void widenRanges(const float* nearness, int width, float softness, float* min, float* max);

}  // namespace grove::objects::lightfield
