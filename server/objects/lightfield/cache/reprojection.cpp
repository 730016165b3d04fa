#include "objects/lightfield/cache/reprojection.h"

#include <algorithm>
#include <array>
#include <vector>

#include "objects/lightfield/cache/reprojection_tile.h"

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

/// Where the rays of a tile go. Where a ray is in the picture depends on its pixel and its nearness so that it is
/// farthest out at their ends.
struct TileRays {
  std::array<world::Vec2, 4> places;
  std::array<world::Vec2, 4> ways;
  int ahead = 0;  ///< how many corners go where the picture's camera looks

  TileRays(const ViewWarp& warp, int left, int top) {
    std::size_t i = 0;
    for (const int x : {left, left + kTileWidth}) {
      for (const int y : {top, top + kTileHeight}) {
        ahead += warp.forward(x, y) >= kLeastForward ? 1 : 0;
        places[i] = warp.place(x, y);
        ways[i] = warp.way(places[i]);
        ++i;
      }
    }
  }

  /// The range of the texels that they pass at nearnesses of `range`.
  [[nodiscard]] CachedView::Range passed(const CachedView& view, const CachedView::Range& range) const {
    world::Vec2 low(1.0e9F);
    world::Vec2 high(-1.0e9F);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const world::Vec2 far = places[i] + ways[i] * range.least;
      const world::Vec2 near = places[i] + ways[i] * range.greatest;
      low = glm::min(low, glm::min(far, near));
      high = glm::max(high, glm::max(far, near));
    }
    const auto width = static_cast<float>(view.width());
    const auto height = static_cast<float>(view.height());
    if (high.x < 0.0F || high.y < 0.0F || low.x > width || low.y > height) return {};
    constexpr float kSquare = CachedView::kSquare;
    const int firstColumn = static_cast<int>(std::max(low.x - 1.0F, 0.0F) / kSquare);
    const int firstRow = static_cast<int>(std::max(low.y - 1.0F, 0.0F) / kSquare);
    const int lastColumn = static_cast<int>(std::min(high.x + 1.0F, width - 1.0F) / kSquare);
    const int lastRow = static_cast<int>(std::min(high.y + 1.0F, height - 1.0F) / kSquare);
    CachedView::Range reach{range.greatest, 0.0F};
    for (int row = firstRow; row <= lastRow; ++row) {
      for (int column = firstColumn; column <= lastColumn; ++column) {
        const CachedView::Range& square = view.range(column, row);
        reach.least = std::min(reach.least, square.least);
        reach.greatest = std::max(reach.greatest, square.greatest);
      }
    }
    return reach;
  }
};

Reach reachOf(const CachedView& view, const ViewWarp& warp, float mostSpeed, int left, int top) {
  const TileRays rays(warp, left, top);
  if (rays.ahead == 0) return {};
  // Some of its rays go nowhere and their ends tell nothing.
  if (rays.ahead < 4) return {view.range(), mostSpeed};
  Reach reach{rays.passed(view, view.range())};
  // What is left of the range is often so little that the rays pass much less.
  if (reach.shows()) reach.range = rays.passed(view, reach.range);
  float speed = 1.0e-20F;
  for (const world::Vec2& way : rays.ways) speed = std::max(speed, glm::length(way));
  reach.texelsPerNearness = std::min(speed, mostSpeed);
  return reach;
}

/// Runs that are whole have a length that the compiler knows.
template <class T>
void put(const T* from, int count, T* to) {
  if (count == kTileWidth) {
    std::copy_n(from, kTileWidth, to);
  } else {
    std::copy_n(from, count, to);
  }
}

template <class T>
void fill(T value, int count, T* to) {
  if (count == kTileWidth) {
    std::fill_n(to, kTileWidth, value);
  } else {
    std::fill_n(to, count, value);
  }
}

}  // namespace

void reproject(const CachedView& view, const ObjectCamera& camera, const Haze& haze, node::Image& image) {
  const world::Rect rect = image.rect;
  image.spans.assign(static_cast<std::size_t>(std::max(rect.height(), 0)), node::Span{});
  if (rect.empty() || view.empty()) return;
  const ViewWarp warp(view, camera);
  const float mostSpeed = std::max(mostTexelsPerNearness(view, warp), 1.0e-20F);
  WarpTile tile;
  std::vector<Reach> reaches(static_cast<std::size_t>((rect.width() + kTileWidth - 1) / kTileWidth));
  for (int top = 0; top < rect.height(); top += kTileHeight) {
    const int rows = std::min(kTileHeight, rect.height() - top);
    for (std::size_t i = 0; i < reaches.size(); ++i) {
      reaches[i] = reachOf(view, warp, mostSpeed, rect.left + static_cast<int>(i) * kTileWidth, rect.top + top);
    }
    const auto first = std::ranges::find_if(reaches, &Reach::shows);
    if (first == reaches.end()) continue;
    const auto end = std::ranges::find_if(reaches.rbegin(), reaches.rend(), &Reach::shows).base();
    const node::Span span{static_cast<int>(first - reaches.begin()) * kTileWidth,
                          std::min(static_cast<int>(end - reaches.begin()) * kTileWidth, rect.width())};
    std::fill_n(image.spans.begin() + top, rows, span);
    for (int left = span.begin; left < span.end; left += kTileWidth) {
      const int columns = std::min(kTileWidth, rect.width() - left);
      const Reach& reach = reaches[static_cast<std::size_t>(left / kTileWidth)];
      const bool nothing = !reach.shows();
      if (!nothing) {
        beginTile(warp, rect.left + left, rect.top + top, tile);
        searchTile(view, warp, reach.range, reach.texelsPerNearness, tile);
        shadeTile(view, warp, haze, tile);
      }
      for (int row = 0; row < rows; ++row) {
        std::uint32_t* colour = image.colourRow(top + row) + left;
        float* depth = image.depthRow(top + row) + left;
        if (nothing) {
          fill(0U, columns, colour);
          fill(world::kInfiniteDepth, columns, depth);
        } else {
          put(tile.colour + row * kTileWidth, columns, colour);
          put(tile.depth + row * kTileWidth, columns, depth);
        }
      }
    }
  }
}

}  // namespace grove::objects::lightfield
