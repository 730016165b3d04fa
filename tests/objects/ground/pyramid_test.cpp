#include "objects/ground/pyramid.h"

#include <gtest/gtest.h>

namespace grove::objects::ground {
namespace {

TEST(Pyramid, EachLevelAveragesTheFinerOneChannelByChannel) {
  std::vector<std::uint32_t> texels(16, 0x10203040U);
  texels[0] = 0x50607080U;
  const Pyramid pyramid(4, texels);
  ASSERT_EQ(pyramid.levels(), 3);
  EXPECT_EQ(pyramid.level(0)[0], 0x50607080U);
  EXPECT_EQ(pyramid.level(1)[0], 0x20304050U);
  EXPECT_EQ(pyramid.level(1)[3], 0x10203040U);
  EXPECT_EQ(pyramid.level(2)[0], 0x14243444U);
}

TEST(Pyramid, PackingRoundsAndClamps) {
  EXPECT_EQ(packTexel(0.0F, 1.0F, 0.5F, 2.0F), 0xFF80FF00U);
  EXPECT_EQ(packTexel(-1.0F, 0.0F, 0.0F, 0.0F), 0U);
}

}  // namespace
}  // namespace grove::objects::ground
