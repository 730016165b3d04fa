#include "objects/lightfield/cache/reprojection.h"

#include <algorithm>
#include <vector>

#include "objects/lightfield/cache/reprojection_tile.h"

namespace grove::objects::lightfield {
namespace {

/// By how many texels a ray moves in the picture for one unit of nearness, at most; it is farthest at a corner.
float texelsPerNearness(const ViewWarp& warp, const world::Rect& rect) {
  float most = 1.0e-20F;
  for (const int x : {rect.left, rect.right}) {
    for (const int y : {rect.top, rect.bottom}) most = std::max(most, glm::length(warp.way(warp.place(x, y))));
  }
  return most;
}

/// The nearnesses that the rays of a tile can meet; greatest is 0 if there are none.
CachedView::Range reachOf(const CachedView& view, const ViewWarp& warp, int left, int top) {
  world::Vec2 low(1.0e9F);
  world::Vec2 high(-1.0e9F);
  const CachedView::Range whole = view.range();
  bool ahead = true;
  // Where a ray is in the picture depends on its pixel and its nearness so that it is farthest out at their ends.
  for (const int x : {left, left + kTileWidth}) {
    for (const int y : {top, top + kTileHeight}) {
      ahead &= warp.forward(x, y) >= kLeastForward;
      const world::Vec2 a = warp.place(x, y);
      const world::Vec2 b = warp.way(a);
      const world::Vec2 far = a + b * whole.least;
      const world::Vec2 near = a + b * whole.greatest;
      low = glm::min(low, glm::min(far, near));
      high = glm::max(high, glm::max(far, near));
    }
  }
  int firstColumn = 0;
  int firstRow = 0;
  int lastColumn = view.squaresAcross() - 1;
  int lastRow = view.squaresDown() - 1;
  CachedView::Range reach;
  if (ahead) {
    constexpr float kSquare = CachedView::kSquare;
    const auto width = static_cast<float>(view.width());
    const auto height = static_cast<float>(view.height());
    if (high.x < 0.0F || high.y < 0.0F || low.x > width || low.y > height) return reach;
    firstColumn = static_cast<int>(std::max(low.x - 1.0F, 0.0F) / kSquare);
    firstRow = static_cast<int>(std::max(low.y - 1.0F, 0.0F) / kSquare);
    lastColumn = static_cast<int>(std::min(high.x + 1.0F, width - 1.0F) / kSquare);
    lastRow = static_cast<int>(std::min(high.y + 1.0F, height - 1.0F) / kSquare);
  }
  reach.least = whole.greatest;
  for (int row = firstRow; row <= lastRow; ++row) {
    for (int column = firstColumn; column <= lastColumn; ++column) {
      const CachedView::Range& range = view.range(column, row);
      reach.least = std::min(reach.least, range.least);
      reach.greatest = std::max(reach.greatest, range.greatest);
    }
  }
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
  const float speed = texelsPerNearness(warp, rect);
  WarpTile tile;
  std::vector<CachedView::Range> reaches(static_cast<std::size_t>((rect.width() + kTileWidth - 1) / kTileWidth));
  for (int top = 0; top < rect.height(); top += kTileHeight) {
    const int rows = std::min(kTileHeight, rect.height() - top);
    for (std::size_t i = 0; i < reaches.size(); ++i) {
      reaches[i] = reachOf(view, warp, rect.left + static_cast<int>(i) * kTileWidth, rect.top + top);
    }
    const auto shows = [](const CachedView::Range& reach) { return reach.greatest > 0.0F; };
    const auto first = std::ranges::find_if(reaches, shows);
    if (first == reaches.end()) continue;
    const auto end = std::find_if(reaches.rbegin(), reaches.rend(), shows).base();
    const node::Span span{static_cast<int>(first - reaches.begin()) * kTileWidth,
                          std::min(static_cast<int>(end - reaches.begin()) * kTileWidth, rect.width())};
    std::fill_n(image.spans.begin() + top, rows, span);
    for (int left = span.begin; left < span.end; left += kTileWidth) {
      const int columns = std::min(kTileWidth, rect.width() - left);
      const CachedView::Range& reach = reaches[static_cast<std::size_t>(left / kTileWidth)];
      const bool nothing = !shows(reach);
      if (!nothing) {
        beginTile(warp, rect.left + left, rect.top + top, tile);
        searchTile(view, warp, reach, speed, tile);
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
