#include "world/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace grove::world {
namespace {

Camera lookingAlong(float yaw, float pitch = 0.0F) {
  Camera camera;
  camera.pose = {{0, 1.7F, 0}, yaw, pitch};
  return camera;
}

TEST(Camera, YawZeroLooksAlongMinusZAndGrowsToTheLeft) {
  EXPECT_NEAR(lookingAlong(0).pose.forward().z, -1.0F, 1e-6F);
  EXPECT_NEAR(lookingAlong(glm::half_pi<float>()).pose.forward().x, -1.0F, 1e-6F);
}

TEST(Camera, ProjectionUndoesTheRay) {
  Camera camera = lookingAlong(0.7F, -0.3F);
  const Vec3 point = camera.pose.position + 12.5F * camera.ray(300.5F, 411.5F);
  const Vec3 pixel = camera.project(point);
  EXPECT_NEAR(pixel.x, 300.5F, 0.01F);
  EXPECT_NEAR(pixel.y, 411.5F, 0.01F);
  EXPECT_NEAR(pixel.z, 12.5F, 1e-4F);
}

TEST(Camera, MatricesAgreeWithProject) {
  const Camera camera = lookingAlong(-1.1F, 0.2F);
  const Vec3 point = camera.pose.position + 7.0F * camera.ray(900.0F, 200.0F);
  const Vec4 clip = camera.projection() * camera.view() * Vec4(point, 1.0F);
  EXPECT_NEAR((clip.x / clip.w * 0.5F + 0.5F) * 1280.0F, 900.0F, 0.05F);
  EXPECT_NEAR((0.5F - clip.y / clip.w * 0.5F) * 720.0F, 200.0F, 0.05F);
  EXPECT_NEAR(clip.w, 7.0F, 1e-4F);
}

TEST(Camera, SeesOnlyTheFront) {
  const Camera camera = lookingAlong(0);
  const Bounds ahead{{-1, 0, -11}, {1, 2, -9}};
  const Bounds behind{{-1, 0, 9}, {1, 2, 11}};
  const Bounds farLeft{{-60, 0, -11}, {-58, 2, -9}};
  const Bounds around{{-1, 0, -1}, {1, 3, 1}};
  EXPECT_TRUE(camera.sees(ahead));
  EXPECT_FALSE(camera.sees(behind));
  EXPECT_FALSE(camera.sees(farLeft));
  EXPECT_TRUE(camera.sees(around));
  EXPECT_FALSE(camera.sees(Bounds{}));
}

TEST(Camera, ScreenRectContainsEveryCorner) {
  const Camera camera = lookingAlong(0.1F);
  const Bounds box{{-2, 0, -12}, {1, 3, -9}};
  const Rect rect = camera.screenRect(box);
  for (const Vec3 corner : box.corners()) {
    const Vec3 p = camera.project(corner);
    EXPECT_GE(p.x, static_cast<float>(rect.left));
    EXPECT_LE(p.x, static_cast<float>(rect.right));
    EXPECT_GE(p.y, static_cast<float>(rect.top));
    EXPECT_LE(p.y, static_cast<float>(rect.bottom));
  }
  EXPECT_LT(rect.width(), 700);
}

TEST(Camera, ScreenRectAroundTheEyeIsTheWholeImage) {
  EXPECT_EQ(lookingAlong(0).screenRect({{-1, 0, -1}, {1, 3, 1}}), (Rect{0, 0, 1280, 720}));
}

/// Fails if a box that the near plane cuts takes the whole image.
TEST(Camera, ScreenRectOfGrassAtTheFeetIsTheLowerPart) {
  const Camera camera = lookingAlong(0);
  const float eye = camera.pose.position.y;
  const Bounds grass{{-1, eye - 1.7F, -1}, {1, eye - 1.2F, 1}};
  const Rect rect = camera.screenRect(grass);
  EXPECT_EQ(rect.left, 0);
  EXPECT_EQ(rect.right, 1280);
  EXPECT_EQ(rect.bottom, 720);
  const Vec3 edge = camera.project({0, eye - 1.7F, -1});
  const Vec3 upper = camera.project({0, eye - 1.2F, -1});
  EXPECT_LT(upper.y, edge.y);
  EXPECT_EQ(rect.top, std::min(720, static_cast<int>(upper.y)));
}

/// Points of the box beyond the near plane, wherever the eye is.
TEST(Camera, ScreenRectContainsAllVisiblePoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-2.0F, 2.0F);
  for (int i = 0; i < 2000; ++i) {
    Camera camera = lookingAlong(3.0F * place(random));
    camera.pose.pitch = 0.7F * place(random);
    Bounds box;
    box.add(camera.pose.position + Vec3(place(random), place(random), place(random)));
    box.add(camera.pose.position + Vec3(place(random), place(random), place(random)));
    const Rect rect = camera.screenRect(box);
    for (int k = 0; k < 20; ++k) {
      const Vec3 at = Vec3(place(random), place(random), place(random)) * 0.25F + 0.5F;
      const Vec3 p = camera.project(glm::mix(box.low, box.high, at));
      const bool shows = p.z >= camera.nearDepth && p.x >= 0 && p.x < 1280 && p.y >= 0 && p.y < 720;
      if (!shows) continue;
      ASSERT_GE(p.x, static_cast<float>(rect.left) - 0.01F);
      ASSERT_LE(p.x, static_cast<float>(rect.right) + 0.01F);
      ASSERT_GE(p.y, static_cast<float>(rect.top) - 0.01F);
      ASSERT_LE(p.y, static_cast<float>(rect.bottom) + 0.01F);
    }
  }
}

}  // namespace
}  // namespace grove::world
