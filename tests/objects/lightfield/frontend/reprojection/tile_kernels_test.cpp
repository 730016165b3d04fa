#include "objects/lightfield/frontend/reprojection/tile_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

#include "each_target.h"
#include "objects/lightfield/frontend/reprojection/strip_kernels.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr int kEdge = 96;

/// Cards of several depths and coverages, with gaps.
std::shared_ptr<raster::Image> cards() {
  std::shared_ptr<raster::Image> image = raster::ImagePool().acquire({0, 0, kEdge, kEdge});
  std::ranges::fill(image->colour, 0U);
  std::ranges::fill(image->depth, world::kInfiniteDepth);
  std::mt19937 random(6);
  for (int card = 0; card < 60; ++card) {
    const int left = static_cast<int>(random() % (kEdge - 12));
    const int top = static_cast<int>(random() % (kEdge - 12));
    const std::uint32_t alpha = card % 4 == 0 ? 90 : 255;
    const std::uint32_t colour = alpha << 24U | (random() % (alpha + 1)) << 16U | (random() % (alpha + 1)) << 8U;
    const float depth = 2.0F + 0.05F * static_cast<float>(60 - card);
    for (int y = top; y < top + 9; ++y) {
      for (int x = left; x < left + 11; ++x) {
        image->colourRow(y)[x] = colour + random() % (alpha / 2);
        image->depthRow(y)[x] = depth + 0.01F * static_cast<float>(x - left);
      }
    }
  }
  return image;
}

ObjectCamera cardsCamera() {
  ObjectCamera camera;
  camera.corner = {-0.48F, -0.48F, 1.0F};
  camera.perColumn = {0.01F, 0.0F, 0.0F};
  camera.perRow = {0.0F, 0.01F, 0.0F};
  return camera;
}

struct Pixel {
  std::array<float, 4> colour{};
  float depth = world::kInfiniteDepth;
};

/// What reproject() says of one pixel, step by step.
class PlainWarp {
 public:
  PlainWarp(const CachedView& view, const ViewWarp& warp, const Haze& haze, const Reach& reach)
      : view_(view), warp_(warp), haze_(haze), reach_(reach) {}

  [[nodiscard]] Pixel pixel(int x, int y) const {
    const Vec3 k =
        warp_.k + (static_cast<float>(x) + 0.5F) * warp_.kPerColumn + (static_cast<float>(y) + 0.5F) * warp_.kPerRow;
    const float forward = std::max(k.z, kMinForward);
    const world::Vec2 a = world::Vec2(k) / forward;
    const auto [place, near] = search(a);
    const world::Vec2 at = glm::clamp(a + warp_.way(a) * place - 0.5F, world::Vec2(0.0F), limit());
    const int column = static_cast<int>(at.x);
    const int row = static_cast<int>(at.y);
    const float fx = at.x - static_cast<float>(column);
    const float fy = at.y - static_cast<float>(row);
    const auto channel = [&](int dx, int dy, std::size_t i) {
      return static_cast<float>(view_.colour()[(row + dy) * view_.width() + column + dx] >> (8U * i) & 255U);
    };
    Pixel pixel;
    const auto mixed = [&](std::size_t i) {
      return (channel(0, 0, i) * (1.0F - fx) + channel(1, 0, i) * fx) * (1.0F - fy) +
             (channel(0, 1, i) * (1.0F - fx) + channel(1, 1, i) * fx) * fy;
    };
    const float cover = mixed(3);
    if (near <= 0.0F || cover < 0.5F) return pixel;
    for (std::size_t i = 0; i < 3; ++i) {
      pixel.colour[i] = mixed(i) * (1.0F - haze_.amount) + haze_.colour[i] * haze_.amount * cover;
    }
    pixel.colour[3] = cover;
    pixel.depth = (1.0F / near - warp_.m.z) / forward;
    return pixel;
  }

 private:
  struct Found {
    float place;
    float near;
  };

  [[nodiscard]] world::Vec2 limit() const {
    return {static_cast<float>(view_.width()) - 1.001F, static_cast<float>(view_.height()) - 1.001F};
  }
  [[nodiscard]] float ranked(world::Vec2 a, float w) const {
    const world::Vec2 at = glm::clamp(a + warp_.way(a) * w, world::Vec2(0.0F), limit());
    return view_.nearness()[static_cast<int>(at.y) * view_.width() + static_cast<int>(at.x)];
  }
  [[nodiscard]] float nearnessOf(float rank) const { return rank < 0.0F ? rank + view_.softness() : rank; }

  [[nodiscard]] Found search(world::Vec2 a) const {
    const float range = reach_.range.max - reach_.range.min;
    const float way = range * reach_.texelsPerNearness;
    if (way < 0.5F) {
      const float w = reach_.range.min + 0.5F * range;
      const float near = nearnessOf(ranked(a, w));
      return {near > 0.0F ? near : w, near};
    }
    const float steps = std::clamp(std::ceil(std::max(std::min(way, 4.0F), 0.5F * way)), 1.0F, 8.0F);
    const float step = range / steps;
    const float permitted = 0.5F * step + 0.4F / reach_.texelsPerNearness;
    bool lies = false;
    float best = 0.0F;
    float bestPlace = 0.0F;
    float far = 1.0e30F;
    float farPlace = 0.0F;
    for (int j = 0; static_cast<float>(j) < steps; ++j) {
      const float w = reach_.range.max - (static_cast<float>(j) + 0.5F) * step;
      const float rank = ranked(a, w);
      const float near = nearnessOf(rank);
      if (std::abs(near - w) <= permitted && (!lies || rank > best)) {
        lies = true;
        best = rank;
        bestPlace = w;
        if (rank >= 0.0F) break;  // hides what is behind
      }
      if (near < far) {
        far = near;
        farPlace = w;
      }
    }
    if (!lies) return {farPlace, far};
    const float w = nearnessOf(best);
    const float near = nearnessOf(ranked(a, w));
    if (std::abs(near - w) <= permitted) return {near, near};
    return {near > w ? bestPlace : w, w};
  }

  const CachedView& view_;
  const ViewWarp& warp_;
  const Haze& haze_;
  const Reach& reach_;
};

/// Fails if a target looks up, decides, mixes or rounds otherwise. Tolerance: 2 of 255 for weights that are rounded to
/// 256ths and a thousandth of depth; one pixel in a hundred may fall on another side of an edge.
TEST(TileKernels, MatchesScalarOnEveryTarget) {
  const CachedView view(*cards(), cardsCamera());
  const TileHaze haze{{{0.2F, 0.5F, 0.9F}, 0.35F}, 0.04F};
  // Straight on, aside, turned to and fro about the axis, and far away.
  std::array<ObjectCamera, 6> cameras;
  cameras.fill(cardsCamera());
  cameras[1].eye = {0.06F, -0.03F, 0.0F};
  cameras[2].eye = {-0.06F, 0.02F, 0.1F};
  cameras[2].perColumn = {0.01F, 0.0015F, 0.0F};
  cameras[3].eye = {0.04F, 0.05F, 0.0F};
  cameras[3].perColumn = {0.009F, -0.004F, 0.001F};
  cameras[4].perColumn = {0.004F, 0.009F, 0.0F};
  cameras[4].perRow = {-0.009F, 0.004F, 0.0F};
  cameras[5].eye = {0.013F, 0.007F, -3.0F};  // right behind, whole rows of rays run between two texels
  tests::onEachTarget([&] {
    for (const ObjectCamera& camera : cameras) {
      const ViewWarp warp(view, camera);
      for (const float texelsPerNearness : {0.5F, 8.0F, 40.0F, 1.0e4F}) {
        const Reach reach{view.range(), texelsPerNearness};
        int different = 0;
        int shown = 0;
        WarpTile tile;
        for (int top = -3; top < kEdge + 3; top += kTileHeight) {
          for (int left = -5; left < kEdge + 5; left += kTileWidth) {
            const bool shows = warpTile(view, warp, haze, reach, left, top, tile);
            const int before = shown;
            for (int i = 0; i < kTilePixels; ++i) {
              Haze ofRow = haze.first;
              const int row = i / kTileWidth;
              ofRow.amount += static_cast<float>(row) * haze.perRow;
              const Pixel expected = PlainWarp(view, warp, ofRow, reach).pixel(left + i % kTileWidth, top + row);
              bool differs = std::abs(tile.depth[i] - expected.depth) > 0.001F * expected.depth;
              for (std::size_t c = 0; c < 4; ++c) {
                differs |= std::abs(static_cast<float>(tile.colour[i] >> (8U * c) & 255U) - expected.colour[c]) > 2.0F;
              }
              different += differs ? 1 : 0;
              shown += tile.colour[i] != 0 ? 1 : 0;
            }
            EXPECT_EQ(shows, shown > before);
          }
        }
        EXPECT_GT(shown, 500);
        EXPECT_LE(different, shown / 100) << "camera " << &camera - cameras.data() << ", " << texelsPerNearness;
      }
    }
  });
}

/// Fails if a target bounds a tile's rays by other corners or leaves out the last.
TEST(StripKernels, MatchesScalarOnEveryTarget) {
  const CachedView view(*cards(), cardsCamera());
  ObjectCamera camera = cardsCamera();
  camera.eye = {0.1F, -0.05F, 0.2F};
  camera.perColumn = {0.008F, 0.001F, -0.005F};  // the last columns look back
  const ViewWarp warp(view, camera);
  const CachedView::Range range = view.range();
  tests::onEachTarget([&] {
    CornerLine lines[2];
    setCorners(warp, range, -200, 10, lines[0]);
    setCorners(warp, range, -200, 10 + kTileHeight, lines[1]);
    for (int line = 0; line < 2; ++line) {
      for (int i = 0; i < kCorners; ++i) {
        const Vec3 k = warp.k + static_cast<float>(-200 + i * kTileWidth) * warp.kPerColumn +
                       static_cast<float>(10 + line * kTileHeight) * warp.kPerRow;
        const world::Vec2 a = world::Vec2(k) / std::max(k.z, kMinForward);
        const world::Vec2 ends[2] = {a + warp.way(a) * range.min, a + warp.way(a) * range.max};
        const float slack = 1.0e-3F + 1.0e-5F * glm::length(a);
        const CornerLine& corners = lines[line];
        ASSERT_NEAR(corners.forward[i], k.z, 1.0e-4F);
        ASSERT_NEAR(corners.x[i], a.x, slack);
        ASSERT_NEAR(corners.y[i], a.y, slack);
        ASSERT_NEAR(corners.lowX[i], std::min(ends[0].x, ends[1].x), slack);
        ASSERT_NEAR(corners.highX[i], std::max(ends[0].x, ends[1].x), slack);
        ASSERT_NEAR(corners.lowY[i], std::min(ends[0].y, ends[1].y), slack);
        ASSERT_NEAR(corners.highY[i], std::max(ends[0].y, ends[1].y), slack);
      }
    }
    StripTiles tiles;
    placeTiles(lines[0], lines[1], view.width(), view.height(), tiles);
    int misses = 0;
    int whole = 0;
    for (int i = 0; i < kStripTiles; ++i) {
      float low[2] = {1.0e30F, 1.0e30F};
      float high[2] = {-1.0e30F, -1.0e30F};
      int ahead = 0;
      for (const CornerLine& corners : lines) {
        for (const int at : {i, i + 1}) {
          low[0] = std::min(low[0], corners.lowX[at]);
          high[0] = std::max(high[0], corners.highX[at]);
          low[1] = std::min(low[1], corners.lowY[at]);
          high[1] = std::max(high[1], corners.highY[at]);
          ahead += corners.forward[at] >= kMinForward ? 1 : 0;
        }
      }
      const bool aside = high[0] < 0.0F || high[1] < 0.0F || low[0] > static_cast<float>(view.width()) ||
                         low[1] > static_cast<float>(view.height());
      ASSERT_EQ(tiles.whole[i] != 0, ahead > 0 && ahead < 4) << i;
      ASSERT_EQ(tiles.misses[i] != 0, ahead == 0 || (ahead == 4 && aside)) << i;
      misses += tiles.misses[i];
      whole += tiles.whole[i];
    }
    EXPECT_GT(misses, 0);
    EXPECT_GT(whole, 0);
    EXPECT_LT(misses + whole, kStripTiles);
  });
}

}  // namespace
}  // namespace grove::objects::lightfield
