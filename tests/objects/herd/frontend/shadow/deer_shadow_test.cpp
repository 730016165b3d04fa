#include "objects/herd/frontend/shadow/deer_shadow.h"

#include <gtest/gtest.h>

#include "objects/herd/frontend/meadow.h"

namespace grove::objects::herd {
namespace {

using world::Vec3;

constexpr int kUnshaded = 0x80;

/// A doe amid a plain, seen from above.
class DeerShadowTest : public testing::Test {
 protected:
  DeerShadowTest() { meadow_.view_.camera.pose = {{0.0F, 7.0F, 5.0F}, 0.0F, -0.95F}; }

  Meadow meadow_;  // with the sun in the west, half as high as far
};

/// Would catch shadows that point to the sun, and those of another length.
TEST_F(DeerShadowTest, LiesOnTheFarSideFromTheSun) {
  meadow_.add(Meadow::animal(standingAt({0, 0, 0})));
  meadow_.show();
  // The trunk's middle is 0.75 m high: its shadow is 1.5 m to the east.
  EXPECT_LT(meadow_.brightnessAt({1.5F, 0.0F, 0.0F}), kUnshaded * 3 / 4);
  EXPECT_EQ(meadow_.brightnessAt({-1.5F, 0.0F, 0.0F}), kUnshaded);
  EXPECT_EQ(meadow_.brightnessAt({3.5F, 0.0F, 0.5F}), kUnshaded) << "it ends";
  EXPECT_EQ(meadow_.brightnessAt({1.5F, 0.0F, 1.5F}), kUnshaded) << "it is as wide as the animal is long";
}

/// Would catch a black ground: the sky lights a shadow.
TEST_F(DeerShadowTest, KeepsSomeLightAndAlpha) {
  meadow_.add(Meadow::animal(standingAt({0, 0, 0})));
  meadow_.show();
  for (int y = 0; y < Meadow::kHeight; ++y) {
    for (int x = 0; x < Meadow::kWidth; ++x) {
      const std::uint32_t colour = meadow_.colourAt(x, y);
      ASSERT_EQ(colour >> 24U, 0xFFU);
      if (!meadow_.isBody(x, y)) {
        ASSERT_GT(colour >> 8U & 0xFFU, kUnshaded / 6U);
      }
    }
  }
}

/// Would catch a sun's shadow in the shade of trees, and animals that float there: their hooves still darken the
/// ground.
TEST_F(DeerShadowTest, InShadeOnlyTheGroundBelowIsDarker) {
  meadow_.add(Meadow::animal(standingAt({0, 0, 0}), Kind::kDoe, 0.0F));
  meadow_.show();
  EXPECT_EQ(meadow_.brightnessAt({1.5F, 0.0F, 0.0F}), kUnshaded);
  EXPECT_LT(meadow_.brightnessAt({0.25F, 0.0F, 0.0F}), kUnshaded - 8);
}

/// Would catch shadows while the sun is down.
TEST_F(DeerShadowTest, NeedsTheSun) {
  meadow_.sky_.sun = glm::normalize(Vec3(-1.0F, -0.1F, 0.0F));
  meadow_.add(Meadow::animal(standingAt({0, 0, 0})));
  meadow_.show();
  EXPECT_EQ(meadow_.brightnessAt({1.5F, 0.0F, 0.0F}), kUnshaded);
}

/// Would catch a sun near the horizon whose shadows cross the whole meadow.
TEST_F(DeerShadowTest, ALowSunsShadowEnds) {
  meadow_.sky_.sun = glm::normalize(Vec3(-1.0F, 0.02F, 0.0F));
  meadow_.view_.camera.pose = {{10.0F, 12.0F, 9.0F}, 0.0F, -0.95F};
  meadow_.add(Meadow::animal(standingAt({0, 0, 0})));
  meadow_.show();
  EXPECT_LT(meadow_.brightnessAt({4.0F, 0.0F, -0.31F}), kUnshaded);
  EXPECT_EQ(meadow_.brightnessAt({17.0F, 0.0F, 0.0F}), kUnshaded);
}

/// Would catch shadows that float beside an animal on a slope: they lie on the plane of its feet.
TEST_F(DeerShadowTest, FollowsThePlaneOfTheFeet) {
  AnimalPose pose = standingAt({0, 0, 0});
  const float slope = 0.2F;
  for (Vec3& foot : pose.feet) foot.y = -slope * foot.z;
  const Ground ground(pose);
  EXPECT_NEAR(ground.height.at({0.0F, -slope * 0.7F, 0.7F}), 0.0F, 0.01F);
  EXPECT_NEAR(ground.height.at({0.4F, 0.5F, 0.0F}), 0.5F, 0.01F);
}

/// Would catch a lifted hoof that tilts the ground, and its shadow with it.
TEST_F(DeerShadowTest, ALiftedHoofDoesNotTiltTheGround) {
  AnimalPose pose = standingAt({0, 0, 0});
  pose.feet[kLeftFore].y += 0.2F;
  const Ground ground(pose);
  EXPECT_NEAR(ground.height.at({1.0F, 0.0F, 1.0F}), 0.0F, 1.0e-4F);
}

/// Would catch a mask that misses its caster, or that has holes between its lines.
TEST(SunMaskTest, HidesTheSunBehindALineOnly) {
  const Capsule post{{0, 0, 0}, {0, 1, 0}, 0.1F, 0.1F};
  const SunMask mask(std::span(&post, 1), glm::normalize(Vec3(-1, 1, 0)), {0, 0, 0});
  const auto at = [&](Vec3 point) { return mask.at(mask.column().at(point), mask.line().at(point)); };
  EXPECT_GT(at({0.5F, 0, 0}), 0.95F);
  EXPECT_LT(at({0.5F, 0, 0.25F}), 0.05F);
  EXPECT_EQ(at({1.6F, 0, 0}), 0.0F);
  EXPECT_EQ(at({-0.5F, 0, 0}), 0.0F);
}

/// Would catch a hull that leaves out pixels of its body, or that takes much more.
TEST(ScreenHullTest, ContainsItsCornersTightly) {
  world::Camera camera;
  camera.pose.position = {0, 1, 0};
  const std::array<Vec3, 4> corners{Vec3(-1, 0, -5), Vec3(1, 0, -5), Vec3(1, 0, -8), Vec3(-1, 0, -8)};
  const world::Rect all{0, 0, camera.width, camera.height};
  const ScreenHull hull(corners, camera, all);
  const Vec3 middle = camera.project({0, 0, -6});
  const auto row = hull.row(static_cast<int>(middle.y));
  const auto edge = camera.project({1, 0, -6});
  EXPECT_NEAR(static_cast<float>(row.end), edge.x, 3.0F);
  EXPECT_NEAR(static_cast<float>(row.begin), 2.0F * middle.x - edge.x, 3.0F);
  const std::array<Vec3, 2> behind{Vec3(0, 0, 5), Vec3(1, 0, 5)};
  EXPECT_TRUE(ScreenHull(behind, camera, all).rect().empty());
  const std::array<Vec3, 2> through{Vec3(0, 0, 5), Vec3(1, 0, -5)};
  EXPECT_GE(ScreenHull(through, camera, all).rect().bottom, camera.height - 1) << "it comes to the eye";
}

}  // namespace
}  // namespace grove::objects::herd
