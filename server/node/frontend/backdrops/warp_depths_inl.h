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

/// The squares of a backdrop as a grid.
struct SquareGrid {
  const SquareNearness* squares;
  int across;
  int down;
};

#if GROVE_SIMD_PERMUTES
/// Looks up squares in two registers of each of two rows, which hold what neighbours of a frame show. False if they do
/// not.
HWY_INLINE bool lookUpSquaresNear(const SquareGrid& grid, Ints column, Ints row, Ints& out) {
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
  const std::ptrdiff_t begin = std::ptrdiff_t{top} * grid.across + left;
  if (begin + grid.across + 2 * kLanes > std::ptrdiff_t{grid.across} * grid.down || lanes::any(outside != Ints(0))) {
    return false;
  }
  // Of the cells below these, which are probably shown there.
  __builtin_prefetch(grid.squares + begin + 5 * std::ptrdiff_t{grid.across});
  const auto rowAt = [&](const SquareNearness* from) {
    const hn::Rebind<SquareNearness, lanes::IntTag> tag;
    lanes::RowPart<lanes::IntTag> part(hn::PromoteTo(lanes::IntTag(), hn::LoadU(tag, from)),
                                       hn::PromoteTo(lanes::IntTag(), hn::LoadU(tag, from + kLanes)));
    return Ints(part.at(right));
  };
  out = lanes::select(down == Ints(0), rowAt(grid.squares + begin), rowAt(grid.squares + begin + grid.across));
  return true;
}
#else
HWY_INLINE bool lookUpSquaresNear(const SquareGrid&, Ints, Ints, Ints&) { return false; }
#endif

/// Interpolates between corners at the centres of kLanes squares of 2 x 2 pixels of the frame, from square `first` of
/// the row on, which is a multiple of kLanes.
HWY_INLINE Floats betweenSquares(const float* corners, int first) {
  const Ints square = lanes::upwards() + Ints(first);
  const Floats place = (lanes::toFloats((square & Ints(3)) * Ints(2)) + 1.0F) * 0.125F;
  const auto indices = hn::IndicesFromVec(lanes::FloatTag(), lanes::shiftRight<2>(lanes::upwards()).raw);
  const auto at = [&](const float* from) {
    return Floats(hn::TableLookupLanes(hn::LoadU(lanes::FloatTag(), from), indices));
  };
  const Floats begin = at(corners + first / 4);
  return lanes::mulAdd(place, at(corners + first / 4 + 1) - begin, begin);
}

/// View depths in the frame of kLanes of its squares.
HWY_INLINE Floats depthsOfSquares(const WarpSource& source, const RowCorners& corners, const float* perForward,
                                  int first) {
  const SquareGrid grid{source.squares, source.width / 2, source.height / 2};
  const auto place = [&](const float* from, int count) {
    return lanes::truncate(lanes::clamp(betweenSquares(from, first) * 0.5F, 0.0F, static_cast<float>(count - 1)));
  };
  const Ints column = place(corners.x, grid.across);
  const Ints row = place(corners.y, grid.down);
  Ints steps;
  if (!lookUpSquaresNear(grid, column, row, steps)) steps = lanes::lookUp(grid.squares, row * grid.across + column);
  const Floats depth = (kNearnessSteps / lanes::toFloats(steps) - source.m2) * betweenSquares(perForward, first);
  return lanes::select(steps > Ints(0), depth, world::kInfiniteDepth);
}

/// Depths of a row of cells, one for each square of 2 x 2 pixels: the backdrop's are no finer.
HWY_INLINE void warpDepths(const WarpSource& source, const CornerLine& above, const CornerLine& below, int count,
                           float* depth, std::ptrdiff_t stride) {
  constexpr int kSide = 8;
  float depths[kWarpPixels / 2 + kLanes];
  const int width = count * kSide;
  for (int row = 0; row < kSide; row += 2) {
    const float down = (static_cast<float>(row) + 1.0F) / kSide;
    const RowCorners corners(above, below, down);
    float perForward[kCorners];
    for (int i = 0; i < kCorners; ++i) {
      perForward[i] = above.perForward[i] + down * (below.perForward[i] - above.perForward[i]);
    }
    for (int i = 0; i < width / 2; i += kLanes)
      lanes::store(depthsOfSquares(source, corners, perForward, i), depths + i);
    float* __restrict const upper = depth + row * stride;
    float* __restrict const lower = upper + stride;
    for (int i = 0; i < width / 2; ++i) {
      upper[2 * i] = depths[i];
      upper[2 * i + 1] = depths[i];
      lower[2 * i] = depths[i];
      lower[2 * i + 1] = depths[i];
    }
  }
}

}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
