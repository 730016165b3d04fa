#pragma once

#include <cstdint>

#include "world/camera.h"

namespace grove::objects::lightfield {

/// Whether a raster::Image's pixel shows anything; its "nothing" is kInfiniteDepth.
[[nodiscard]] constexpr bool showsAnything(std::uint32_t colour, float depth) noexcept {
  return (depth < 0.5F * world::kInfiniteDepth) & (colour >> 24U != 0);
}

/// Where a row of pixels shows anything: columns from `begin` to before `end`; nothing where end <= begin.
struct CoveredSpan {
  int begin = 0;
  int end = 0;
  float nearest = world::kInfiniteDepth;  ///< depth
};

/// Of a row of a raster::Image.
[[nodiscard]] CoveredSpan coveredSpan(const std::uint32_t* colour, const float* depth, int width);

/// The largest of each value and its two neighbours, but for those at the ends.
void widenRow(const float* near, int width, float* wide);

/// Makes one row of CachedView::nearness() of 1 / depth; of the widened rows above, here and below too.
void rankRow(const float* above, const float* here, const float* below, const std::uint32_t* colour, int width,
             float softness, float* nearness);

/// Widens each column's range of 1 / depth by a row of CachedView::nearness().
void widenRanges(const float* nearness, int width, float softness, float* min, float* max);

}  // namespace grove::objects::lightfield
