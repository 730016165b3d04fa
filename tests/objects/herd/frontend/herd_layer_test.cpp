#include "objects/herd/frontend/herd_layer.h"

#include <gtest/gtest.h>

#include "objects/herd/frontend/meadow.h"

namespace grove::objects::herd {
namespace {

using world::Vec3;

class HerdLayerTest : public testing::Test {
 protected:
  Meadow meadow_;
};

/// Would catch an animal of the wrong size, or one that is not drawn at all.
TEST_F(HerdLayerTest, ADoeStandsSixMetresAway) {
  meadow_.add(Meadow::animal(standingAt({0, 0, 0}, 1.5707963F)));
  meadow_.show();
  // A trunk of 1 m x 0.4 m alone has 0.4 m^2; a body in its box of 1.8 m x 1.5 m fills less than half of it.
  const float pixelsPerSquareMetre = std::pow(meadow_.view_.camera.focal() / 6.0F, 2.0F);
  EXPECT_GT(static_cast<float>(meadow_.bodyPixels()), 0.35F * pixelsPerSquareMetre);
  EXPECT_LT(static_cast<float>(meadow_.bodyPixels()), 1.2F * pixelsPerSquareMetre);
}

/// Would catch a coat of another colour, such as that of swapped channels.
TEST_F(HerdLayerTest, DeerAreBrown) {
  meadow_.sky_.sun = glm::normalize(Vec3(0.3F, 0.4F, 1.0F));
  meadow_.add(Meadow::animal(standingAt({0, 0, 0}, 1.5707963F)));
  meadow_.show();
  int brown = 0;
  meadow_.forEachBodyPixel([&](int x, int y) {
    const std::uint32_t colour = meadow_.colourAt(x, y);
    const std::uint32_t red = colour & 0xFFU;
    const std::uint32_t green = colour >> 8U & 0xFFU;
    const std::uint32_t blue = colour >> 16U & 0xFFU;
    if (red > green + 8U && green > blue) ++brown;
  });
  EXPECT_GT(brown, meadow_.bodyPixels() * 2 / 3);
}

/// Would catch animals that shine through stones and trees.
TEST_F(HerdLayerTest, WhatIsNearerHidesIt) {
  meadow_.add(Meadow::animal(standingAt({0, 0, 0}, 1.5707963F)));
  meadow_.show({.wall = 2.0F});
  EXPECT_EQ(meadow_.changedPixels(), 0);
}

/// Would catch a body that is the ground's shade: its own shadow must not lie on it.
TEST_F(HerdLayerTest, ABodyIsNotInItsOwnShadow) {
  meadow_.add(Meadow::animal(standingAt({0, 0, 0}, 1.5707963F)));
  meadow_.show();
  Meadow without;
  without.add(Meadow::animal(standingAt({0, 0, 0}, 1.5707963F)));
  without.show({.shadows = false});
  int darker = 0;
  meadow_.forEachBodyPixel([&](int x, int y) { darker += meadow_.colourAt(x, y) == without.colourAt(x, y) ? 0 : 1; });
  EXPECT_LT(darker, meadow_.bodyPixels() / 25) << "only hooves may be darker, and edges";
}

/// Would catch the nearer of two animals behind the other.
TEST_F(HerdLayerTest, TheNearerAnimalIsInFront) {
  meadow_.add(Meadow::animal(standingAt({0, 0, -3}, 1.5707963F)));
  meadow_.add(Meadow::animal(standingAt({0, 0, 0}, 1.5707963F)));
  meadow_.show();
  const Vec3 trunk = meadow_.view_.camera.project({0.0F, 0.75F, 0.0F});
  EXPECT_NEAR(meadow_.depthAt(static_cast<int>(trunk.x), static_cast<int>(trunk.y)), trunk.z, 0.4F);
}

/// Would catch work for animals that nobody sees, and pictures of what is behind the eye.
TEST_F(HerdLayerTest, DrawsNothingBehindTheCameraOrFarAway) {
  meadow_.add(Meadow::animal(standingAt({0, 0, 20})));
  meadow_.add(Meadow::animal(standingAt({0, 0, -HerdLayer::kFarthest})));
  meadow_.show();
  EXPECT_EQ(meadow_.parts_, 0U);
  EXPECT_TRUE(meadow_.reach_.empty());
  EXPECT_EQ(meadow_.changedPixels(), 0);
}

/// Would catch pixels that are drawn but not sent: a frame sends only what layers reach.
TEST_F(HerdLayerTest, ReachContainsAllThatItDraws) {
  meadow_.add(Meadow::animal(standingAt({-1, 0, 0}, 0.5F), Kind::kBuck));
  meadow_.add(Meadow::animal(grazingAt({1.5F, 0, -1}, 2.0F)));
  meadow_.add(Meadow::animal(walkingAt({0.3F, 0, -6}, -1.0F), Kind::kFawn));
  meadow_.show();
  const world::Rect reach = meadow_.reach_;
  int outside = 0;
  for (int y = 0; y < Meadow::kHeight; ++y) {
    for (int x = 0; x < Meadow::kWidth; ++x) {
      const bool isInside = x >= reach.left && x < reach.right && y >= reach.top && y < reach.bottom;
      if (!isInside && meadow_.colourAt(x, y) != Meadow::kGround) ++outside;
    }
  }
  EXPECT_EQ(outside, 0);
  EXPECT_GT(meadow_.changedPixels(), 3000);
}

/// Would catch antlers, ears or muzzles that are cut off at the picture's edge: a picture of all of the frame shows as
/// much.
TEST_F(HerdLayerTest, PicturesCutNothingOff) {
  for (const auto& pose : {standingAt({0, 0, 0}, 0.8F), grazingAt({0, 0, 0}, 2.2F), walkingAt({0, 0, 0}, -1.2F)}) {
    Meadow meadow;
    meadow.add(Meadow::animal(pose, Kind::kBuck));
    meadow.show();
    const world::Rect reach = meadow.reach_;
    meadow.forEachBodyPixel([&](int x, int y) {
      EXPECT_GT(x, reach.left);
      EXPECT_LT(x, reach.right - 1);
      EXPECT_GT(y, reach.top);
    });
  }
}

/// Would catch pages that guess a walking animal's place without its motion, and those that move what stands.
TEST_F(HerdLayerTest, TheNearestWalkingAnimalIsAMover) {
  Animal walking = Meadow::animal(standingAt({0, 0, -2}));
  walking.before.place.x -= 1.5F / static_cast<float>(kTicksPerSecond);
  meadow_.add(Meadow::animal(standingAt({1, 0, 0})));
  meadow_.show();
  EXPECT_FALSE(meadow_.mover_);
  meadow_.add(walking);
  meadow_.show();
  ASSERT_TRUE(meadow_.mover_);
  EXPECT_NEAR(meadow_.mover_->velocity.x, 1.5F, 0.02F);
  EXPECT_LT(meadow_.mover_->nearest, 8.0F);
  EXPECT_GT(meadow_.mover_->farthest, 8.0F);
  meadow_.view_.time = 1.0;
  meadow_.show();
  EXPECT_FALSE(meadow_.mover_) << "the newest tick is old";
}

/// Would catch a crash or garbage for an eye amid the herd.
TEST_F(HerdLayerTest, AnEyeMayTouchAnAnimal) {
  meadow_.add(Meadow::animal(standingAt({0, 0, 6.1F}, 0.7F)));
  meadow_.view_.camera.pose.position.y = 0.9F;
  meadow_.show();
  EXPECT_GT(meadow_.parts_, 0U);
}

}  // namespace
}  // namespace grove::objects::herd
