#include "objects/lightfield/backend/near/near_tiles.h"

#include <gtest/gtest.h>

#include <random>

namespace grove::objects::lightfield {
namespace {

ScreenFace squareAt(float x, float y, float size, float nearness) {
  return {.x = {x, x + size, x + size, x},
          .y = {y, y, y + size, y + size},
          .nearness = {nearness, nearness, nearness, nearness},
          .colour = {1, 1, 1, 1}};
}

/// Fails if a tile is drawn without a face that touches it, which leaves a straight cut.
TEST(NearTiles, FacesAreInAllTilesThatTheyTouch) {
  NearTiles tiles;
  tiles.begin(200, 100);
  EXPECT_TRUE(tiles.touched().empty());
  tiles.add(squareAt(190, 10, 5, 1));
  EXPECT_EQ(tiles.touched(), (world::Rect{128, 0, 200, 64}));
  tiles.begin(200, 100);
  tiles.add(squareAt(60, 10, 10, 1));
  tiles.add(squareAt(-50, -50, 400, 1));
  tiles.add(squareAt(190, 90, 100, 1));
  const std::size_t expected[2][4] = {{2, 2, 1, 1}, {1, 1, 2, 2}};
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 4; ++column) EXPECT_EQ(tiles.at(column, row).size(), expected[row][column]);
  }
  const TileFace& corner = tiles.at(1, 0).front();
  EXPECT_EQ(corner.face, 0U);
  EXPECT_EQ(corner.left, 0);
  EXPECT_EQ(corner.right, 0);
  EXPECT_EQ(corner.top, 1);
  EXPECT_EQ(corner.bottom, 2);
  tiles.begin(64, 64);
  EXPECT_TRUE(tiles.at(0, 0).empty());
}

/// Fails if far faces hide near ones.
TEST(NearTiles, FacesAreSortedFrontToBack) {
  NearTiles tiles;
  tiles.begin(64, 64);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> depth(0.3F, 20.0F);
  for (int i = 0; i < 1000; ++i) tiles.add(squareAt(10, 10, 5, 1.0F / depth(random)));
  tiles.sort(0, 0);
  const std::span<const TileFace> sorted = tiles.at(0, 0);
  ASSERT_EQ(sorted.size(), 1000U);
  for (std::size_t i = 1; i < 1000; ++i) {
    // Keys are steps of nearness.
    EXPECT_LE(tiles.face(sorted[i].face).nearness[0], tiles.face(sorted[i - 1].face).nearness[0] + 3.0e-4F);
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
