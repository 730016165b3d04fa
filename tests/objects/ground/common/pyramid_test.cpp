#include "objects/ground/common/pyramid.h"

#include <gtest/gtest.h>

namespace grove::objects::ground {
namespace {

TEST(Pyramid, EachLevelAveragesTheFinerOne) {
  std::vector<std::uint32_t> texels(16, 0x10203040U);
  texels[0] = 0x50607080U;
  const Pyramid pyramid(4, texels);
  ASSERT_EQ(pyramid.levels(), 3);
  EXPECT_EQ(pyramid.level(0)[0], 0x50607080U);
  EXPECT_EQ(pyramid.level(1)[0], 0x20304050U);
  EXPECT_EQ(pyramid.level(1)[3], 0x10203040U);
  EXPECT_EQ(pyramid.level(2)[0], 0x14243444U);
}

TEST(Pyramid, BlocksHoldSquaresContiguously) {
  std::vector<std::uint32_t> texels(64);
  for (std::uint32_t i = 0; i < 64; ++i) texels[i] = i;
  const Pyramid rows(8, texels);
  const Pyramid blocks = rows.inBlocks();
  const auto* finest = blocks.level(0);
  for (std::size_t y = 0; y < 8; ++y) {
    for (std::size_t x = 0; x < 8; ++x) {
      const std::size_t block = y / 4 * 2 + x / 4;
      EXPECT_EQ(finest[block * 16 + y % 4 * 4 + x % 4], y * 8 + x) << x << ", " << y;
    }
  }
  // A level of a single block is as it was, and so are the levels that are smaller.
  for (const int level : {1, 2, 3}) {
    const auto count = static_cast<std::size_t>(64 >> (2 * level));
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(blocks.level(level)[i], rows.level(level)[i]) << level;
  }
}

TEST(Pyramid, PackingRoundsAndClamps) {
  EXPECT_EQ(packTexel(0.0F, 1.0F, 0.5F, 2.0F), 0xFF80FF00U);
  EXPECT_EQ(packTexel(-1.0F, 0.0F, 0.0F, 0.0F), 0U);
}

}  // namespace
}  // namespace grove::objects::ground
