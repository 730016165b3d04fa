#include "node/frontend/backdrops/backdrop_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "node/frontend/backdrops/backdrop_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "node/frontend/backdrops/warp_depths_inl.h"
#include "node/frontend/backdrops/warp_planes_inl.h"
#include "node/frontend/backdrops/warp_stretched_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {
namespace {

constexpr int kSide = 8;
/// Anything at or beyond this depth counts as infinitely far.
constexpr float kFarthestDepth = 1.0e29F;

/// Sums of columns of pixels, which are added by cell after the last row.
struct ColumnSums {
  static constexpr int kColumns = 256;
  float count[kColumns];
  float nearness[kColumns];
  float squares[kColumns];
  float nearest[kColumns];

  HWY_INLINE void clear() {
    for (int x = 0; x < kColumns; ++x) {
      count[x] = 0.0F;
      nearness[x] = 0.0F;
      squares[x] = 0.0F;
      nearest[x] = 0.0F;
    }
  }

  /// Writes the row's nearness to `near`.
  HWY_INLINE void add(const float* __restrict depth, int width, float* __restrict near) {
    for (int x = 0; x < width; ++x) {
      const float d = depth[x];
      const bool has = d < kFarthestDepth;
      const float w = has ? 1.0F / d : 0.0F;
      count[x] += has ? 1.0F : 0.0F;
      nearness[x] += w;
      squares[x] += w * w;
      nearest[x] = nearest[x] > w ? nearest[x] : w;
      near[x] = w;
    }
  }

  HWY_INLINE CellDepths cell(int first, int width) const {
    CellDepths sums{};
    for (int x = first; x < first + width; ++x) {
      sums.count += count[x];
      sums.nearness += nearness[x];
      sums.squares += squares[x];
      sums.nearest = std::max(sums.nearest, nearest[x]);
    }
    return sums;
  }
};

HWY_INLINE void packRow(const float* __restrict nearness, int width, PixelNearness* __restrict out) {
  constexpr float kMax = 65535.0F;
  for (int x = 0; x < width; ++x) {
    const float steps = nearness[x] * kNearnessSteps + 0.5F;
    out[x] = static_cast<PixelNearness>(static_cast<int>(steps < kMax ? steps : kMax));
  }
}

void measureCells(const float* depths, int width, int lines, CellDepths* cells, const NearnessRows& pixels) {
  ColumnSums columns;
  float nearness[ColumnSums::kColumns];
  for (int left = 0; left < width; left += ColumnSums::kColumns) {
    const int part = std::min(ColumnSums::kColumns, width - left);
    columns.clear();
    for (int line = 0; line < lines; ++line) {
      columns.add(depths + std::ptrdiff_t{line} * width + left, part, nearness);
      packRow(nearness, part, pixels.first + line * pixels.stride + left);
    }
    for (int x = 0; x < part; x += kSide) *cells++ = columns.cell(x, std::min(kSide, part - x));
  }
}

/// Between the cells' centres.
HWY_INLINE Floats nearnessAt(const CornerSearch& search, Floats x, Floats y) {
  const Floats u = lanes::clamp(lanes::mulAdd(x, 1.0F / kSide, -0.5F), 0.0F, static_cast<float>(search.across - 1));
  const Floats v = lanes::clamp(lanes::mulAdd(y, 1.0F / kSide, -0.5F), 0.0F, static_cast<float>(search.down - 1));
  const Ints column = lanes::min(lanes::truncate(u), Ints(std::max(search.across - 2, 0)));
  const Ints row = lanes::min(lanes::truncate(v), Ints(std::max(search.down - 2, 0)));
  const Floats right = u - lanes::toFloats(column);
  const Floats down = v - lanes::toFloats(row);
  const Ints at = row * search.across + column;
  const std::ptrdiff_t next = search.across > 1 ? 1 : 0;
  const std::ptrdiff_t below = search.down > 1 ? search.across : 0;
  const auto line = [&](const float* from) {
    const Floats begin = lanes::lookUp(from, at);
    return lanes::mulAdd(right, lanes::lookUp(from + next, at) - begin, begin);
  };
  const Floats upper = line(search.nearness);
  return lanes::mulAdd(down, line(search.nearness + below) - upper, upper);
}

void findCorners(const CornerSearch& search, int left, int line, int steps, CornerLine& corners) {
  const WarpCamera& warp = search.warp;
  const world::Vec3 first = warp.at(static_cast<float>(left), static_cast<float>(line));
  for (int i = 0; i < kCorners; i += lanes::kLanes) {
    const Floats pixels = lanes::toFloats(lanes::upwards() + i) * static_cast<float>(kSide);
    const Floats forward = lanes::mulAdd(pixels, warp.kPerColumn.z, first.z);
    const Floats perForward = lanes::onlyWhere(forward > kMinForward, 1.0F / forward);
    const Floats farX = lanes::mulAdd(pixels, warp.kPerColumn.x, first.x) * perForward;
    const Floats farY = lanes::mulAdd(pixels, warp.kPerColumn.y, first.y) * perForward;
    const Floats wayX = warp.m.x - farX * warp.m.z;
    const Floats wayY = warp.m.y - farY * warp.m.z;
    const Floats fromX = farX - search.origin.x;
    const Floats fromY = farY - search.origin.y;
    Floats nearness = lanes::load(corners.nearness + i);
    for (int step = 0; step < steps; ++step) {
      nearness = nearnessAt(search, lanes::mulAdd(nearness, wayX, fromX), lanes::mulAdd(nearness, wayY, fromY));
    }
    lanes::store(lanes::mulAdd(nearness, wayX, fromX), corners.x + i);
    lanes::store(lanes::mulAdd(nearness, wayY, fromY), corners.y + i);
    lanes::store(nearness, corners.nearness + i);
    lanes::store(perForward, corners.perForward + i);
  }
}

void warpCells(const WarpSource& source, const CornerLine& above, const CornerLine& below, int count,
               const WarpedPixels& out) {
  const std::uint32_t stretched = warpGroups(source, above, below, count, out);
  for (int cell = 0; cell < count; ++cell) {
    if ((stretched >> static_cast<unsigned>(cell) & 1U) != 0) warpStretched(source, above, below, cell, out);
  }
}

}  // namespace
}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::node {

HWY_EXPORT(measureCells);
HWY_EXPORT(findCorners);
HWY_EXPORT(warpCells);
HWY_EXPORT(warpDepths);

void measureCells(const float* depths, int width, int lines, CellDepths* cells, const NearnessRows& pixels) {
  HWY_DYNAMIC_DISPATCH(measureCells)(depths, width, lines, cells, pixels);
}

void findCorners(const CornerSearch& search, int left, int line, int steps, CornerLine& corners) {
  HWY_DYNAMIC_DISPATCH(findCorners)(search, left, line, steps, corners);
}

void warpCells(const WarpSource& source, const CornerLine& above, const CornerLine& below, int count,
               const WarpedPixels& out) {
  HWY_DYNAMIC_DISPATCH(warpCells)(source, above, below, count, out);
}

void warpDepths(const WarpSource& source, const CornerLine& above, const CornerLine& below, int count, float* depth,
                std::ptrdiff_t stride) {
  HWY_DYNAMIC_DISPATCH(warpDepths)(source, above, below, count, depth, stride);
}

}  // namespace grove::node

#endif  // HWY_ONCE
