// Depths of a warped backdrop. For kernels: included once per target.

#if defined(GROVE_NODE_FRONTEND_BACKDROPS_WARP_DEPTHS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_NODE_FRONTEND_BACKDROPS_WARP_DEPTHS_INL_H
#undef GROVE_NODE_FRONTEND_BACKDROPS_WARP_DEPTHS_INL_H
#else
#define GROVE_NODE_FRONTEND_BACKDROPS_WARP_DEPTHS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "base/simd/row_part_inl.h"
#include "node/frontend/backdrops/backdrop_kernels.h"
#include "node/frontend/backdrops/warp_places_inl.h"
#include "world/camera.h"

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {

/// The pixels of a backdrop.
struct NearnessGrid {
  const PixelNearness* pixels;
  int width;
  int height;
};

#if GROVE_SIMD_PERMUTES
/// Looks up pixels in two registers of each of two rows, which hold what neighbours of a frame show. False if they do
/// not.
HWY_INLINE bool lookUpNearby(const NearnessGrid& grid, Ints column, Ints row, Ints& out) {
  const auto ends = [](Ints places) {
    const int first = hn::GetLane(places.raw);
    const int last = hn::ExtractLane(places.raw, kLanes - 1);
    return std::min(first, last);
  };
  const int left = ends(column);
  const int top = ends(row);
  const Ints right = column - left;
  const Ints down = row - top;
  // Shifted with their signs.
  const Ints outside = hn::Or(hn::ShiftRight<(kLanes == 16 ? 5 : 4)>(right.raw), hn::ShiftRight<1>(down.raw));
  const std::ptrdiff_t begin = std::ptrdiff_t{top} * grid.width + left;
  if (begin + grid.width + 2 * kLanes > std::ptrdiff_t{grid.width} * grid.height || lanes::any(outside != Ints(0))) {
    return false;
  }
  // Of the cells below these, which are probably shown there.
  __builtin_prefetch(grid.pixels + begin + 9 * std::ptrdiff_t{grid.width});
  const auto rowAt = [&](const PixelNearness* from) {
    const hn::Rebind<PixelNearness, lanes::IntTag> tag;
    lanes::RowPart<lanes::IntTag> part(hn::PromoteTo(lanes::IntTag(), hn::LoadU(tag, from)),
                                       hn::PromoteTo(lanes::IntTag(), hn::LoadU(tag, from + kLanes)));
    return Ints(part.at(right));
  };
  out = lanes::select(down == Ints(0), rowAt(grid.pixels + begin), rowAt(grid.pixels + begin + grid.width));
  return true;
}
#else
HWY_INLINE bool lookUpNearby(const NearnessGrid&, Ints, Ints, Ints&) { return false; }
#endif

/// Interpolates between corners at the centres of kLanes pixels of the frame, from pixel `first` of the row on, which is
/// a multiple of kLanes.
HWY_INLINE Floats betweenCorners(const float* corners, int first) {
  const Ints pixel = lanes::upwards() + Ints(first % 8);
  const Floats place = (lanes::toFloats(pixel & Ints(7)) + 0.5F) * 0.125F;
  if constexpr (kLanes <= 8) {
    const float* const begin = corners + first / 8;
    return lanes::mulAdd(place, Floats(begin[1] - begin[0]), Floats(begin[0]));
  }
  const auto indices = hn::IndicesFromVec(lanes::FloatTag(), lanes::shiftRight<3>(pixel).raw);
  const auto at = [&](const float* from) {
    return Floats(hn::TableLookupLanes(hn::LoadU(lanes::FloatTag(), from), indices));
  };
  const Floats begin = at(corners + first / 8);
  return lanes::mulAdd(place, at(corners + first / 8 + 1) - begin, begin);
}

/// View depths in the frame of kLanes of its pixels.
HWY_INLINE Floats depthsOf(const WarpSource& source, const RowCorners& corners, const float* perForward, int first) {
  const NearnessGrid grid{source.nearness, source.width, source.height};
  const auto place = [&](const float* from, int count) {
    return lanes::truncate(lanes::clamp(betweenCorners(from, first), 0.0F, static_cast<float>(count - 1)));
  };
  const Ints column = place(corners.x, grid.width);
  const Ints row = place(corners.y, grid.height);
  Ints steps;
  if (!lookUpNearby(grid, column, row, steps)) steps = lanes::lookUp(grid.pixels, row * grid.width + column);
  const Floats depth = (kNearnessSteps / lanes::toFloats(steps) - source.m2) * betweenCorners(perForward, first);
  return lanes::select(steps > Ints(0), depth, world::kInfiniteDepth);
}

/// Depths of a row of cells.
HWY_INLINE void warpDepths(const WarpSource& source, const CornerLine& above, const CornerLine& below, int count,
                           float* depth, std::ptrdiff_t stride) {
  constexpr int kSide = 8;
  for (int row = 0; row < kSide; ++row) {
    const float down = (static_cast<float>(row) + 0.5F) / kSide;
    const RowCorners corners(above, below, down);
    float perForward[kCorners];
    for (int i = 0; i < kCorners; ++i) {
      perForward[i] = above.perForward[i] + down * (below.perForward[i] - above.perForward[i]);
    }
    float* __restrict const out = depth + row * stride;
    for (int i = 0; i < count * kSide; i += kLanes) lanes::store(depthsOf(source, corners, perForward, i), out + i);
  }
}

}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
