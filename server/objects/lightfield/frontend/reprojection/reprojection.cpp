#include "objects/lightfield/frontend/reprojection/reprojection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "objects/lightfield/frontend/reprojection/strip_kernels.h"
#include "objects/lightfield/frontend/reprojection/tile_kernels.h"

namespace grove::objects::lightfield {
namespace {

/// Upper bound of the texels that a ray moves per unit of nearness where it hits a texel. The ray is at s with nearness
/// w where b = (m - s m2) / (1 - m2 w), which is largest at a corner of the picture.
float maxTexelsPerNearness(const CachedView& view, const ViewWarp& warp) {
  const CachedView::Range& whole = view.range();
  const float scale = 1.0F - std::max(warp.m.z * whole.min, warp.m.z * whole.max);
  float fastest = 0.0F;
  for (const int x : {0, view.width()}) {
    for (const int y : {0, view.height()}) {
      fastest = std::max(fastest, glm::length(warp.way({static_cast<float>(x), static_cast<float>(y)})));
    }
  }
  return fastest / std::max(scale, kMinForward);
}

/// Bounds of the texels that rays pass.
struct Passed {
  world::Vec2 low{1.0e9F};
  world::Vec2 high{-1.0e9F};

  void add(world::Vec2 texel) {
    low = glm::min(low, texel);
    high = glm::max(high, texel);
  }
};

/// The range of the squares that rays pass at nearnesses up to `max`.
CachedView::Range rangeOf(const CachedView& view, const Passed& passed, float max) {
  constexpr float kSquare = CachedView::kSquare;
  const int firstColumn = static_cast<int>(std::max(passed.low.x - 1.0F, 0.0F) / kSquare);
  const int firstRow = static_cast<int>(std::max(passed.low.y - 1.0F, 0.0F) / kSquare);
  const int lastColumn =
      static_cast<int>(std::min(passed.high.x + 1.0F, static_cast<float>(view.width()) - 1.0F) / kSquare);
  const int lastRow =
      static_cast<int>(std::min(passed.high.y + 1.0F, static_cast<float>(view.height()) - 1.0F) / kSquare);
  CachedView::Range range{max, 0.0F};
  for (int row = firstRow; row <= lastRow; ++row) {
    for (int column = firstColumn; column <= lastColumn; ++column) {
      const CachedView::Range& square = view.range(column, row);
      range.min = std::min(range.min, square.min);
      range.max = std::max(range.max, square.max);
    }
  }
  return range;
}

/// Lower bound of the depth at which a ray of this part of the frame hits a texel.
float minDepth(const ViewWarp& warp, const Reach& reach, const world::Rect& part) {
  const auto forward = [&](int x, int y) {
    return warp.k.z + static_cast<float>(x) * warp.kPerColumn.z + static_cast<float>(y) * warp.kPerRow.z;
  };
  const float max = std::max({forward(part.left, part.top), forward(part.right, part.top),
                              forward(part.left, part.bottom), forward(part.right, part.bottom)});
  return (1.0F / reach.range.max - warp.m.z) / std::max(max, kMinForward);
}

/// The tiles between two lines of corners.
class Strip {
 public:
  Strip(const CachedView& view, const ViewWarp& warp, int left, int top)
      : view_(view), warp_(warp), maxSpeed_(std::max(maxTexelsPerNearness(view, warp), 1.0e-20F)), left_(left) {
    setCorners(warp, view.range(), left, top, *below_);
  }

  /// Advances to the tiles that end above `line`.
  void advanceTo(int line) {
    std::swap(above_, below_);
    setCorners(warp_, view_.range(), left_, line, *below_);
    placeTiles(*above_, *below_, view_.width(), view_.height(), tiles_);
  }

  [[nodiscard]] Reach reach(int tile) const {
    if (tiles_.misses[tile] != 0) return {};
    // Some of its rays have no position in the picture, so its corners give no bounds.
    if (tiles_.whole[tile] != 0) return {view_.range(), maxSpeed_};
    const CachedView::Range& whole = view_.range();
    Passed passed;
    for (const CornerLine* line : {above_, below_}) {
      for (const int i : {tile, tile + 1}) {
        passed.add({line->lowX[i], line->lowY[i]});
        passed.add({line->highX[i], line->highY[i]});
      }
    }
    Reach reach{rangeOf(view_, passed, whole.max)};
    if (!reach.shows()) return reach;
    // The rest of the range is often so small that the rays pass far fewer texels.
    Passed less;
    float speed = 1.0e-20F;
    for (const CornerLine* line : {above_, below_}) {
      for (const int i : {tile, tile + 1}) {
        const world::Vec2 place(line->x[i], line->y[i]);
        const world::Vec2 way = warp_.way(place);
        less.add(place + way * reach.range.min);
        less.add(place + way * reach.range.max);
        speed = std::max(speed, glm::dot(way, way));
      }
    }
    reach.range = rangeOf(view_, less, reach.range.max);
    reach.texelsPerNearness = std::min(std::sqrt(speed), maxSpeed_);
    return reach;
  }

 private:
  CornerLine first_;
  CornerLine second_;
  const CachedView& view_;
  const ViewWarp& warp_;
  CornerLine* above_ = &first_;
  CornerLine* below_ = &second_;
  const float maxSpeed_;
  const int left_;
  StripTiles tiles_;
};

}  // namespace

void reproject(const CachedView& view, const ObjectCamera& camera, const LayeredHaze& haze, const world::Rect& rect,
               const LayTile& lay, const HidesTile& hides) {
  if (rect.empty() || view.empty()) return;
  const ViewWarp warp(view, camera);
  WarpTile tile;
  for (int stripLeft = rect.left; stripLeft < rect.right; stripLeft += kStripTiles * kTileWidth) {
    const int tiles = std::min(kStripTiles, (rect.right - stripLeft + kTileWidth - 1) / kTileWidth);
    Strip strip(view, warp, stripLeft, rect.top);
    for (int top = rect.top; top < rect.bottom; top += kTileHeight) {
      strip.advanceTo(top + kTileHeight);
      for (int i = 0; i < tiles; ++i) {
        const Reach reach = strip.reach(i);
        if (!reach.shows()) continue;
        const int left = stripLeft + i * kTileWidth;
        const world::Rect part{left, top, std::min(left + kTileWidth, rect.right),
                               std::min(top + kTileHeight, rect.bottom)};
        if (hides(part, minDepth(warp, reach, part))) continue;
        if (warpTile(view, warp, haze.at(top, kTileHeight), reach, left, top, tile)) lay(part, tile);
      }
    }
  }
}

}  // namespace grove::objects::lightfield
