#include "objects/lightfield/frontend/reprojection/strip_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/frontend/reprojection/strip_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "objects/lightfield/common/lower_upper_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

void setCorners(const ViewWarp& warp, const CachedView::Range& range, int left, int line, CornerLine& corners) {
  const world::Vec3 k = warp.k + static_cast<float>(left) * warp.kPerColumn + static_cast<float>(line) * warp.kPerRow;
  const world::Vec3 step = static_cast<float>(kTileWidth) * warp.kPerColumn;
  const world::Vec3 far = warp.m * range.min;
  const world::Vec3 near = warp.m * range.max;
  for (int i = 0; i < kCorners; ++i) {
    const auto tile = static_cast<float>(i);
    const float forward = k.z + tile * step.z;
    const float scale = 1.0F / upper(forward, kMinForward);
    const float x = (k.x + tile * step.x) * scale;
    const float y = (k.y + tile * step.y) * scale;
    const float farX = x - x * far.z + far.x;
    const float farY = y - y * far.z + far.y;
    const float nearX = x - x * near.z + near.x;
    const float nearY = y - y * near.z + near.y;
    corners.forward[i] = forward;
    corners.x[i] = x;
    corners.y[i] = y;
    corners.lowX[i] = lower(farX, nearX);
    corners.highX[i] = upper(farX, nearX);
    corners.lowY[i] = lower(farY, nearY);
    corners.highY[i] = upper(farY, nearY);
  }
}

/// Min over the four corners of tile i.
HWY_INLINE float lowest(const float* __restrict above, const float* __restrict below, int i) {
  return lower(lower(above[i], above[i + 1]), lower(below[i], below[i + 1]));
}
HWY_INLINE float highest(const float* __restrict above, const float* __restrict below, int i) {
  return upper(upper(above[i], above[i + 1]), upper(below[i], below[i + 1]));
}

void placeTiles(const CornerLine& above, const CornerLine& below, int width, int height, StripTiles& tiles) {
  const auto right = static_cast<float>(width);
  const auto bottom = static_cast<float>(height);
  int* __restrict whole = tiles.whole;
  int* __restrict misses = tiles.misses;
  for (int i = 0; i < kStripTiles; ++i) {
    const float lowX = lowest(above.lowX, below.lowX, i);
    const float lowY = lowest(above.lowY, below.lowY, i);
    const float highX = highest(above.highX, below.highX, i);
    const float highY = highest(above.highY, below.highY, i);
    const float behind = lowest(above.forward, below.forward, i);
    const float ahead = highest(above.forward, below.forward, i);
    const bool aside = (highX < 0.0F) | (highY < 0.0F) | (lowX > right) | (lowY > bottom);
    whole[i] = static_cast<int>((behind < kMinForward) & (ahead >= kMinForward));
    misses[i] = static_cast<int>((ahead < kMinForward) | ((behind >= kMinForward) & aside));
  }
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(setCorners);
HWY_EXPORT(placeTiles);

void setCorners(const ViewWarp& warp, const CachedView::Range& range, int left, int line, CornerLine& corners) {
  HWY_DYNAMIC_DISPATCH(setCorners)(warp, range, left, line, corners);
}

void placeTiles(const CornerLine& above, const CornerLine& below, int width, int height, StripTiles& tiles) {
  HWY_DYNAMIC_DISPATCH(placeTiles)(above, below, width, height, tiles);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
