#include "objects/lightfield/frontend/mixed_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "world/camera.h"

namespace grove::objects::lightfield {
namespace {

using world::kInfiniteDepth;
using world::Rect;

WarpTile tileOf(std::uint32_t colour, float depth) {
  WarpTile tile;
  std::ranges::fill(tile.colour, colour);
  std::ranges::fill(tile.depth, depth);
  return tile;
}

struct Laid {
  Rect part;
  std::uint32_t colour = 0;
  float depth = 0.0F;
};

std::vector<Laid> laid(MixedTiles& tiles) {
  std::vector<Laid> result;
  tiles.forEach([&](const Rect& part, const std::uint32_t* colour, const float* depth) {
    result.push_back({part, colour[0], depth[0]});
  });
  return result;
}

constexpr Rect kHere{16, 8, 32, 16};
constexpr Rect kThere{32, 8, 48, 16};

TEST(MixedTiles, SimilarColoursStay) {
  for (const std::uint32_t colour : {0xFFFFFFFFU, 0xFF0180FEU, 0x80402010U, 0U}) {
    for (int share = 0; share <= 64; ++share) {
      MixedTiles tiles(static_cast<float>(share) / 64.0F);
      tiles.addLeaving(kHere, tileOf(colour, 3.0F));
      tiles.addComing(kHere, tileOf(colour, 3.0F));
      ASSERT_EQ(laid(tiles).at(0).colour, colour) << share;
    }
  }
}

TEST(MixedTiles, CrossFadesColours) {
  MixedTiles tiles(0.25F);
  tiles.addLeaving(kHere, tileOf(0xFF0000FFU, 5.0F));
  tiles.addComing(kHere, tileOf(0xFF00FF00U, 3.0F));
  const auto all = laid(tiles);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].part.left, kHere.left);
  EXPECT_EQ(all[0].colour >> 24U, 0xFFU);
  EXPECT_NEAR(all[0].colour & 0xFFU, 191.0, 1.0);
  EXPECT_NEAR(all[0].colour >> 8U & 0xFFU, 64.0, 1.0);
  EXPECT_EQ(all[0].depth, 3.0F);
}

TEST(MixedTiles, ContentOfOnlyOneFades) {
  MixedTiles tiles(0.25F);
  tiles.addLeaving(kHere, tileOf(0xFFFFFFFFU, 5.0F));
  tiles.addComing(kHere, tileOf(0U, kInfiniteDepth));
  tiles.addComing(kThere, tileOf(0xFFFFFFFFU, 7.0F));
  const auto all = laid(tiles);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].colour, 0xBFBFBFBFU);
  EXPECT_EQ(all[0].depth, 5.0F);
  EXPECT_EQ(all[1].colour, 0x40404040U);
  EXPECT_EQ(all[1].depth, 7.0F);
}

}  // namespace
}  // namespace grove::objects::lightfield
