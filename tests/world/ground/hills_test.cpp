#include "world/ground/hills.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::world {
namespace {

const std::vector<Hill> kHills{{{10.0F, -5.0F}, 8.0F, 1.2F}, {{14.0F, -5.0F}, 4.0F, 0.3F}};

TEST(HillsTest, AddUpAndEndAtTheirRadius) {
  EXPECT_EQ(groundHeight({}, {3.0F, 4.0F}), 0.0F);
  EXPECT_NEAR(groundHeight(std::span(kHills).first(1), {10.0F, -5.0F}), 1.2F, 1e-6F);
  EXPECT_NEAR(groundHeight(kHills, {14.0F, -5.0F}), 1.2F * 0.75F * 0.75F + 0.3F, 1e-6F);
  EXPECT_EQ(groundHeight(kHills, {10.0F, 3.1F}), 0.0F);
}

/// Fails if objects tilt otherwise than the ground below them.
TEST(HillsTest, SlopeIsTheGradient) {
  constexpr float kStep = 1e-2F;
  for (const Vec2 place : {Vec2(12.0F, -3.0F), Vec2(15.5F, -6.0F), Vec2(7.0F, -9.0F), Vec2(30.0F, 0.0F)}) {
    const auto across = [&](Vec2 step) {
      return (groundHeight(kHills, place + step) - groundHeight(kHills, place - step)) / (2.0F * kStep);
    };
    const Vec2 slope = groundSlope(kHills, place);
    EXPECT_NEAR(slope.x, across({kStep, 0.0F}), 1e-3F);
    EXPECT_NEAR(slope.y, across({0.0F, kStep}), 1e-3F);
  }
}

}  // namespace
}  // namespace grove::world
