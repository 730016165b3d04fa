#include "objects/lightfield/frontend/reprojection/tile_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/frontend/reprojection/tile_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "objects/lightfield/frontend/reprojection/shade_inl.h"
#include "objects/lightfield/frontend/reprojection/texels_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

/// A tile's rays are sampled in steps of one texel, or of two where that takes more than kFineSteps: finer steps gain
/// 0.1 dB there. Within the default view error no more than kMaxSteps are needed; stale pictures would need 32 and
/// more, for hardly better pixels.
constexpr float kFineSteps = 4.0F;
constexpr float kMaxSteps = 8.0F;
/// Rays that move by less than this, in texels, stay in their texel.
constexpr float kStill = 0.5F;
/// Permitted distance of a ray's point from the texel's centre beyond half a step, in texels.
constexpr float kSlack = 0.4F;
constexpr float kNothing = -1.0e30F;

HWY_INLINE void beginTile(const ViewWarp& warp, int left, int top, WarpTile& tile) {
  for (int row = 0; row < kTileHeight; ++row) {
    const world::Vec3 k = warp.k + (static_cast<float>(left) + 0.5F) * warp.kPerColumn +
                          (static_cast<float>(top + row) + 0.5F) * warp.kPerRow;
    for (int column = 0; column < kTileWidth; column += kLanes) {
      const Floats x = toFloats(upwards() + column);
      const Floats scale = 1.0F / max(mulAdd(x, warp.kPerColumn.z, k.z), kMinForward);
      const int at = row * kTileWidth + column;
      store(mulAdd(x, warp.kPerColumn.x, k.x) * scale, tile.a0 + at);
      store(mulAdd(x, warp.kPerColumn.y, k.y) * scale, tile.a1 + at);
      store(scale, tile.perForward + at);
    }
  }
}

/// Results of rays that stay in their texels.
HWY_INLINE void glance(const Texels& texels, float w, WarpTile& tile) {
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Floats near = texels.nearnessOf(Rays(tile, i).ranked(texels, w));
    store(select(near > 0.0F, near, w), tile.place + i);
    store(near, tile.near + i);
  }
}

/// Texels that rays have hit so far, as in CachedView::nearness().
struct Met {
  Floats best = kNothing;  ///< the best texel on the ray, or kNothing
  Floats bestPlace;        ///< the w of that texel
  Floats far = -kNothing;  ///< 1 / depth of the farthest texel passed
  Floats farPlace;

  /// The rays pass texels of these ranks at nearness `w`. A ray that has hit a texel that hides the background gets no
  /// further hit, independent of the adjacent rays.
  HWY_INLINE void pass(const Texels& texels, Floats ranked, float w, float permitted) {
    const Floats near = texels.nearnessOf(ranked);
    const Floats lying = select(without(abs(near - w) <= permitted, best >= 0.0F), ranked, kNothing);
    bestPlace = select(lying > best, w, bestPlace);
    best = max(best, lying);
    farPlace = select(near < far, w, farPlace);
    far = min(far, near);
  }
};

/// Decides the texel of each ray. The best texel lies on the ray to half a step; the texel at the place of its depth is
/// better if it belongs to the same surface. If that texel is farther away, the surface ends between both, and the
/// edge's colour is used. If it is nearer, it hides the ray's point, of which only the found texel is known.
HWY_INLINE void settle(const Texels& texels, const Reach& reach, float permitted, const Rays& rays, const Met& met,
                       int i, WarpTile& tile) {
  const Mask lies = met.best > 0.5F * kNothing;
  const Floats found = texels.nearnessOf(met.best);
  const Floats w = select(lies, found, met.farPlace);
  const Floats near = texels.nearnessOf(rays.ranked(texels, w, reach.range.min, reach.range.max));
  const Mask same = abs(near - w) <= permitted;
  const Mask hidden = near > w + permitted;
  const Floats exact = select(same, near, select(hidden, met.bestPlace, w));
  store(select(lies, exact, met.farPlace), tile.place + i);
  store(select(lies, select(same, near, found), met.far), tile.near + i);
}

/// Finds the texel that each ray hits.
HWY_INLINE void searchTile(const Texels& texels, const Reach& reach, WarpTile& tile) {
  const float range = reach.range.max - reach.range.min;
  const float way = range * reach.texelsPerNearness;
  if (way < kStill) return glance(texels, reach.range.min + 0.5F * range, tile);
  const float wanted = std::max(std::min(way, kFineSteps), 0.5F * way);
  const int steps = static_cast<int>(std::clamp(std::ceil(wanted), 1.0F, kMaxSteps));
  const float step = range / static_cast<float>(steps);
  const float permitted = 0.5F * step + kSlack / reach.texelsPerNearness;
  for (int i = 0; i < kTilePixels; i += kLanes) {
    const Rays rays(tile, i);
    Met met;
    for (int j = 0; j < steps; ++j) {
      const float w = reach.range.max - (static_cast<float>(j) + 0.5F) * step;
      met.pass(texels, rays.ranked(texels, w), w, permitted);
      if (all(met.best >= 0.0F)) break;
    }
    settle(texels, reach, permitted, rays, met, i, tile);
  }
}

bool warpTile(const CachedView& view, const ViewWarp& warp, const TileHaze& haze, const Reach& reach, int left, int top,
              WarpTile& tile) {
  beginTile(warp, left, top, tile);
  const Texels texels(view, warp);
  searchTile(texels, reach, tile);
  return shade(texels, view.colour(), haze, tile);
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(warpTile);

bool warpTile(const CachedView& view, const ViewWarp& warp, const TileHaze& haze, const Reach& reach, int left, int top,
              WarpTile& tile) {
  return HWY_DYNAMIC_DISPATCH(warpTile)(view, warp, haze, reach, left, top, tile);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
