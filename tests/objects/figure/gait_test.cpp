#include "objects/figure/backend/gait.h"

#include <gtest/gtest.h>

#include <cmath>

#include "objects/figure/backend/figure_shape.h"

namespace grove::objects::figure {
namespace {

TEST(Gait, LegsAlternateAndRest) {
  world::Player player;
  player.stride = 0.375F;
  const auto foot = [&](Bone leg) {
    return world::Vec3(bonesOf(player, {})[leg] * world::Vec4(0.0F, 0.0F, 0.0F, 1.0F)) -
           world::Vec3(bonesOf(player, {})[kBody] * world::Vec4(0.0F, 0.0F, 0.0F, 1.0F));
  };
  EXPECT_NEAR(foot(kLeftLeg).z, 0.0F, 1.0e-4F);
  player.velocity = {0, 0, -world::kWalkSpeed};
  EXPECT_GT(std::abs(foot(kLeftLeg).z), 0.15F);
  EXPECT_LT(foot(kLeftLeg).z * foot(kRightLeg).z, 0.0F);
}

}  // namespace
}  // namespace grove::objects::figure
