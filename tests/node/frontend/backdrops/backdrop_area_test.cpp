#include "node/frontend/backdrops/backdrop_area.h"

#include <gtest/gtest.h>

#include <cmath>

#include "node/frontend/backdrops/drawn_backdrop.h"

namespace grove::node {
namespace {

const world::Camera kWindow = testing::cameraOf(1280, 720);

world::Camera turnedBy(float yaw, float pitch = 0.0F) {
  world::Camera camera = kWindow;
  camera.pose.yaw += yaw;
  camera.pose.pitch += pitch;
  return camera;
}

TEST(SeenPart, OfTheSameCameraIsTheFrame) {
  EXPECT_EQ(seenPart(kWindow, kWindow, 3.0F), (world::Rect{0, 0, 1280, 720}));
}

TEST(SeenPart, ReachesAsFarAsTheTurnedCameraSees) {
  // Yaw grows to the left.
  const world::Rect part = seenPart(kWindow, turnedBy(0.05F), 3.0F);
  const float edge = std::atan(kWindow.tanHalfX()) + 0.05F;
  EXPECT_NEAR(static_cast<float>(part.left), 640.0F - kWindow.focal() * std::tan(edge), 2.0F);
  EXPECT_LT(part.right, 1280);
}

TEST(SeenPart, TakesWhatIsNearIntoAccount) {
  world::Camera aside = kWindow;
  aside.pose.position.x += 0.3F;
  const float shift = kWindow.focal() * 0.3F / 3.0F;
  EXPECT_NEAR(static_cast<float>(seenPart(kWindow, aside, 3.0F).right), 1280.0F + shift, 2.0F);
}

TEST(SeenPart, OfACameraThatLooksBackIsNothing) {
  EXPECT_TRUE(seenPart(kWindow, turnedBy(3.1F), 3.0F).empty());
  EXPECT_TRUE(seenPart(kWindow, turnedBy(1.2F), 3.0F).empty());
}

TEST(AreaWithBorder, HoldsWhatIsSeenLaterAndIsEven) {
  for (const world::Camera& later : {turnedBy(0.03F), turnedBy(-0.05F, 0.02F), turnedBy(0.0F, -0.04F)}) {
    const auto area = areaWithBorder(kWindow, later, 3.0F);
    ASSERT_TRUE(area);
    const world::Rect seen = seenPart(kWindow, later, 3.0F);
    EXPECT_EQ(world::overlap(*area, seen), seen);
    EXPECT_EQ(world::overlap(*area, evenFrame(kWindow)), evenFrame(kWindow));
    EXPECT_EQ(area->width() % 2, 0);
    EXPECT_EQ(area->height() % 2, 0);
  }
}

TEST(AreaWithBorder, IsTheFrameForACameraThatStandsStill) {
  EXPECT_EQ(areaWithBorder(kWindow, kWindow, 3.0F), evenFrame(kWindow));
}

TEST(AreaWithBorder, IsNotGivenWhereItWouldCostTooMuch) {
  EXPECT_FALSE(areaWithBorder(kWindow, turnedBy(0.5F), 3.0F));
  EXPECT_FALSE(areaWithBorder(kWindow, turnedBy(3.0F), 3.0F));
}

TEST(EvenFrame, RoundsUp) { EXPECT_EQ(evenFrame(testing::cameraOf(431, 243)), (world::Rect{0, 0, 432, 244})); }

}  // namespace
}  // namespace grove::node
