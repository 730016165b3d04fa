#include "node/frontend/backdrops/backdrop_area.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(SeenPart, SameCameraSeesTheFrame) { EXPECT_EQ(seenPart(kWindow, kWindow, 3.0F), (world::Rect{0, 0, 1280, 720})); }

TEST(SeenPart, ReachesTheTurnedFrame) {
  // Yaw grows to the left.
  const world::Rect part = seenPart(kWindow, turnedBy(0.05F), 3.0F);
  const float edge = std::atan(kWindow.tanHalfX()) + 0.05F;
  EXPECT_NEAR(static_cast<float>(part.left), 640.0F - kWindow.focal() * std::tan(edge), 2.0F);
  EXPECT_LT(part.right, 1280);
}

TEST(SeenPart, AccountsForNearContent) {
  world::Camera aside = kWindow;
  aside.pose.position.x += 0.3F;
  const float shift = kWindow.focal() * 0.3F / 3.0F;
  EXPECT_NEAR(static_cast<float>(seenPart(kWindow, aside, 3.0F).right), 1280.0F + shift, 2.0F);
}

TEST(SeenPart, CameraThatLooksBackSeesNothing) {
  EXPECT_TRUE(seenPart(kWindow, turnedBy(3.1F), 3.0F).empty());
  EXPECT_TRUE(seenPart(kWindow, turnedBy(1.2F), 3.0F).empty());
}

const world::Rect kWindowFrame{0, 0, 1280, 720};

TEST(SeenPart, OwnCameraSeesItsFrame) {
  for (const float yaw : {0.0F, 0.7F, 2.9F}) {
    world::Camera camera = turnedBy(yaw, 0.3F);
    camera.pose.position = {123.4F, 1.7F, -56.7F};
    EXPECT_EQ(seenPart(camera, camera, 3.0F), kWindowFrame);
  }
}

TEST(AreaWithBorder, ContainsPresentAndLaterFrameInWholeCells) {
  for (const world::Camera& later : {turnedBy(0.03F), turnedBy(-0.05F, 0.02F), turnedBy(0.0F, -0.04F)}) {
    const world::Rect seen = seenPart(kWindow, later, 3.0F);
    const auto area = areaWithBorder(kWindowFrame, seen, kWindow);
    ASSERT_TRUE(area);
    EXPECT_EQ(world::overlap(*area, seen), seen);
    EXPECT_EQ(world::overlap(*area, kWindowFrame), kWindowFrame);
    for (const int edge : {area->left, area->top, area->right, area->bottom}) EXPECT_EQ(edge % Backdrop::kCell, 0);
  }
}

TEST(AreaWithBorder, EqualsTheFrameForAStillCamera) {
  EXPECT_EQ(areaWithBorder(kWindowFrame, kWindowFrame, kWindow), kWindowFrame);
}

TEST(AreaWithBorder, IsEmptyAboveTheCostLimit) {
  EXPECT_FALSE(areaWithBorder(kWindowFrame, seenPart(kWindow, turnedBy(0.5F), 3.0F), kWindow));
  EXPECT_FALSE(areaWithBorder(kWindowFrame, {}, kWindow)) << "what is seen later is elsewhere";
}

TEST(ExtendedArea, ContainsOldAndNewArea) {
  const world::Rect area{0, 0, 1280, 720};
  const auto extended = extendedArea(area, {-40, -12, 1200, 700}, {-100, -20, 1150, 690}, kWindow);
  ASSERT_TRUE(extended);
  EXPECT_EQ(world::overlap(*extended, area), area);
  EXPECT_LE(extended->left, -100);
  EXPECT_LE(extended->top, -20);
  EXPECT_EQ(extended->right, 1280);
  EXPECT_EQ(extended->bottom, 720);
  for (const int edge : {extended->left, extended->top}) EXPECT_EQ(edge % Backdrop::kCell, 0);
}

/// Fails if the picture of someone who turns round and round grows without end.
TEST(ExtendedArea, DropsInvisibleArea) {
  const world::Rect area{-1200, 0, 1280, 720};
  const auto extended = extendedArea(area, {-1300, 0, 100, 720}, {-1400, 0, 50, 720}, kWindow);
  ASSERT_TRUE(extended);
  EXPECT_LE(extended->left, -1400);
  EXPECT_LT(extended->right, 200);
  EXPECT_FALSE(extendedArea(area, {-3000, -600, 300, 1400}, {-3100, -600, 200, 1400}, kWindow)) << "it is too oblique";
  EXPECT_FALSE(extendedArea(area, {-1300, 0, 100, 720}, {}, kWindow)) << "soon it is out of sight";
  EXPECT_FALSE(extendedArea(area, {}, {-1300, 0, 100, 720}, kWindow)) << "it is out of sight";
}

TEST(PartsBeyond, CoverTheRemainderOnce) {
  const world::Rect area{-16, -8, 40, 32};
  for (const world::Rect& other : {world::Rect{0, 0, 24, 16}, world::Rect{-64, 0, 24, 64}, world::Rect{-16, -8, 32, 24},
                                   world::Rect{100, 0, 140, 40}, area}) {
    const std::vector<world::Rect> parts = partsBeyond(area, other);
    for (int y = area.top; y < area.bottom; ++y) {
      for (int x = area.left; x < area.right; ++x) {
        const world::Rect pixel{x, y, x + 1, y + 1};
        const auto holds = [&](const world::Rect& part) { return !world::overlap(part, pixel).empty(); };
        EXPECT_EQ(std::ranges::count_if(parts, holds), holds(other) ? 0 : 1) << x << " " << y;
      }
    }
    EXPECT_TRUE(std::ranges::none_of(parts, &world::Rect::empty));
  }
}

TEST(WholeCells, CoverTheRectangle) { EXPECT_EQ(wholeCells({0, 0, 431, 243}), (world::Rect{0, 0, 432, 248})); }

}  // namespace
}  // namespace grove::node
