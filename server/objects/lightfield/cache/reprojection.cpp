#include "objects/lightfield/cache/reprojection.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::lightfield {
namespace {

/// What the rays of a tile can meet.
struct Reach {
  CachedView::Range range;         ///< nearnesses; greatest is 0 if there are none
  float texelsPerNearness = 1.0F;  ///< how far a ray moves in the picture for one unit of nearness, at most

  [[nodiscard]] bool shows() const noexcept { return range.greatest > 0.0F; }
};

/// By how many texels a ray that meets a texel moves for one unit of nearness, at most. It is at s with nearness w
/// where b = (m - s m2) / (1 - m2 w), which is largest at a corner of the picture.
float mostTexelsPerNearness(const CachedView& view, const ViewWarp& warp) {
  const CachedView::Range& whole = view.range();
  const float scale = 1.0F - std::max(warp.m.z * whole.least, warp.m.z * whole.greatest);
  float most = 0.0F;
  for (const int x : {0, view.width()}) {
    for (const int y : {0, view.height()}) {
      most = std::max(most, glm::length(warp.way({static_cast<float>(x), static_cast<float>(y)})));
    }
  }
  return most / std::max(scale, kLeastForward);
}

// By value: of references the compiler makes pointers, which it then looks up one by one.
float least(float a, float b, float c, float d) { return std::min(std::min(a, b), std::min(c, d)); }
float most(float a, float b, float c, float d) { return std::max(std::max(a, b), std::max(c, d)); }

/// Tiles side by side whose rays are reckoned together.
constexpr int kStripTiles = 32;
constexpr int kCorners = kStripTiles + 1;

/// The corners of a strip's tiles on one line. Where a ray is in the picture depends on its pixel and its nearness so
/// that it is farthest out at their ends.
struct alignas(64) CornerLine {
  float forward[kCorners];
  float x[kCorners];  ///< places
  float y[kCorners];
  float lowX[kCorners];  ///< of the texels that the rays pass
  float highX[kCorners];
  float lowY[kCorners];
  float highY[kCorners];

  void set(const ViewWarp& warp, const CachedView::Range& range, int left, int line) {
    const world::Vec3 k = warp.k + static_cast<float>(left) * warp.kPerColumn + static_cast<float>(line) * warp.kPerRow;
    const world::Vec3 step = static_cast<float>(kTileWidth) * warp.kPerColumn;
    const world::Vec3 far = warp.m * range.least;
    const world::Vec3 near = warp.m * range.greatest;
    for (int i = 0; i < kCorners; ++i) {
      const auto tile = static_cast<float>(i);
      forward[i] = k.z + tile * step.z;
      const float scale = 1.0F / std::max(forward[i], kLeastForward);
      x[i] = (k.x + tile * step.x) * scale;
      y[i] = (k.y + tile * step.y) * scale;
      const float farX = x[i] - x[i] * far.z + far.x;
      const float farY = y[i] - y[i] * far.z + far.y;
      const float nearX = x[i] - x[i] * near.z + near.x;
      const float nearY = y[i] - y[i] * near.z + near.y;
      lowX[i] = std::min(farX, nearX);
      highX[i] = std::max(farX, nearX);
      lowY[i] = std::min(farY, nearY);
      highY[i] = std::max(farY, nearY);
    }
  }
};

/// The texels that rays pass.
struct Passed {
  world::Vec2 low{1.0e9F};
  world::Vec2 high{-1.0e9F};

  void add(world::Vec2 texel) {
    low = glm::min(low, texel);
    high = glm::max(high, texel);
  }
};

/// Of the squares that rays pass at nearnesses up to `most`.
CachedView::Range rangeOf(const CachedView& view, const Passed& passed, float most) {
  constexpr float kSquare = CachedView::kSquare;
  const int firstColumn = static_cast<int>(std::max(passed.low.x - 1.0F, 0.0F) / kSquare);
  const int firstRow = static_cast<int>(std::max(passed.low.y - 1.0F, 0.0F) / kSquare);
  const int lastColumn =
      static_cast<int>(std::min(passed.high.x + 1.0F, static_cast<float>(view.width()) - 1.0F) / kSquare);
  const int lastRow =
      static_cast<int>(std::min(passed.high.y + 1.0F, static_cast<float>(view.height()) - 1.0F) / kSquare);
  CachedView::Range range{most, 0.0F};
  for (int row = firstRow; row <= lastRow; ++row) {
    for (int column = firstColumn; column <= lastColumn; ++column) {
      const CachedView::Range& square = view.range(column, row);
      range.least = std::min(range.least, square.least);
      range.greatest = std::max(range.greatest, square.greatest);
    }
  }
  return range;
}

/// The tiles between two lines of corners.
class Strip {
 public:
  Strip(const CachedView& view, const ViewWarp& warp, int left, int top)
      : view_(view), warp_(warp), mostSpeed_(std::max(mostTexelsPerNearness(view, warp), 1.0e-20F)), left_(left) {
    below_->set(warp, view.range(), left, top);
  }

  /// Goes on to the tiles that end above `line`.
  void goDownTo(int line) {
    std::swap(above_, below_);
    below_->set(warp_, view_.range(), left_, line);
    const auto width = static_cast<float>(view_.width());
    const auto height = static_cast<float>(view_.height());
    const CornerLine& a = *above_;
    const CornerLine& b = *below_;
    for (int i = 0; i < kStripTiles; ++i) {
      const float lowX = least(a.lowX[i], a.lowX[i + 1], b.lowX[i], b.lowX[i + 1]);
      const float lowY = least(a.lowY[i], a.lowY[i + 1], b.lowY[i], b.lowY[i + 1]);
      const float highX = most(a.highX[i], a.highX[i + 1], b.highX[i], b.highX[i + 1]);
      const float highY = most(a.highY[i], a.highY[i + 1], b.highY[i], b.highY[i + 1]);
      const float behind = least(a.forward[i], a.forward[i + 1], b.forward[i], b.forward[i + 1]);
      const float ahead = most(a.forward[i], a.forward[i + 1], b.forward[i], b.forward[i + 1]);
      const bool aside = (highX < 0.0F) | (highY < 0.0F) | (lowX > width) | (lowY > height);
      whole_[i] = (behind < kLeastForward) & (ahead >= kLeastForward) ? 1 : 0;
      misses_[i] = (ahead < kLeastForward) | ((behind >= kLeastForward) & aside) ? 1 : 0;
    }
  }

  [[nodiscard]] Reach reach(int tile) const {
    if (misses_[tile] != 0) return {};
    // Some of its rays go nowhere and their ends tell nothing.
    if (whole_[tile] != 0) return {view_.range(), mostSpeed_};
    const CachedView::Range& whole = view_.range();
    Passed passed;
    for (const CornerLine* line : {above_, below_}) {
      for (const int i : {tile, tile + 1}) {
        passed.add({line->lowX[i], line->lowY[i]});
        passed.add({line->highX[i], line->highY[i]});
      }
    }
    Reach reach{rangeOf(view_, passed, whole.greatest)};
    if (!reach.shows()) return reach;
    // What is left of the range is often so little that the rays pass much less.
    Passed less;
    float speed = 1.0e-20F;
    for (const CornerLine* line : {above_, below_}) {
      for (const int i : {tile, tile + 1}) {
        const world::Vec2 place(line->x[i], line->y[i]);
        const world::Vec2 way = warp_.way(place);
        less.add(place + way * reach.range.least);
        less.add(place + way * reach.range.greatest);
        speed = std::max(speed, glm::dot(way, way));
      }
    }
    reach.range = rangeOf(view_, less, reach.range.greatest);
    reach.texelsPerNearness = std::min(std::sqrt(speed), mostSpeed_);
    return reach;
  }

 private:
  const CachedView& view_;
  const ViewWarp& warp_;
  const float mostSpeed_;
  const int left_;
  CornerLine first_;
  CornerLine second_;
  CornerLine* above_ = &first_;
  CornerLine* below_ = &second_;
  int whole_[kStripTiles];   ///< 1: the rays at some of its corners go nowhere
  int misses_[kStripTiles];  ///< 1: none of its rays passes the picture
};

}  // namespace

void reproject(const CachedView& view, const ObjectCamera& camera, const Haze& haze, const world::Rect& rect,
               const LayTile& lay) {
  if (rect.empty() || view.empty()) return;
  const ViewWarp warp(view, camera);
  WarpTile tile;
  for (int stripLeft = rect.left; stripLeft < rect.right; stripLeft += kStripTiles * kTileWidth) {
    const int tiles = std::min(kStripTiles, (rect.right - stripLeft + kTileWidth - 1) / kTileWidth);
    Strip strip(view, warp, stripLeft, rect.top);
    for (int top = rect.top; top < rect.bottom; top += kTileHeight) {
      strip.goDownTo(top + kTileHeight);
      for (int i = 0; i < tiles; ++i) {
        const Reach reach = strip.reach(i);
        if (!reach.shows()) continue;
        const int left = stripLeft + i * kTileWidth;
        beginTile(warp, left, top, tile);
        searchTile(view, warp, reach.range, reach.texelsPerNearness, tile);
        if (!shadeTile(view, warp, haze, tile)) continue;
        lay({left, top, std::min(left + kTileWidth, rect.right), std::min(top + kTileHeight, rect.bottom)}, tile);
      }
    }
  }
}

}  // namespace grove::objects::lightfield
