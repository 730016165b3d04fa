#include "world/light.h"

#include <gtest/gtest.h>

namespace grove::world {
namespace {

TEST(Light, DisplayCurveIsMonotonic) {
  EXPECT_NEAR(toDisplay(0.0F), 0.0F, 0.01F);
  float before = 0.0F;
  float x = 0.01F;
  for (int step = 0; step < 37; ++step, x *= 1.2F) {
    EXPECT_GE(toDisplay(x), before);
    before = toDisplay(x);
  }
  EXPECT_LE(before, 1.0F);
  EXPECT_GT(before, 0.9F);
}

TEST(Light, DisplayBytesAreRgbaInMemory) {
  const std::uint32_t red = toDisplayRgba({9.0F, 0.0F, 0.0F});
  EXPECT_GT(red & 0xFFU, 200u);
  EXPECT_LT(red >> 8U & 0xFFU, 10u);
  EXPECT_EQ(red >> 24U, 255u);
}

TEST(Light, HazeGrowsWithDistance) {
  EXPECT_NEAR(hazeAmount(0.0F), 0.0F, 1e-6F);
  EXPECT_LT(hazeAmount(10.0F), hazeAmount(100.0F));
  EXPECT_LT(hazeAmount(1e6F), 1.0001F);
}

}  // namespace
}  // namespace grove::world
