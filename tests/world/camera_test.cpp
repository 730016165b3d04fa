#include "world/camera.h"

#include <gtest/gtest.h>

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

TEST(Camera, SeesWhatIsInFrontOnly) {
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

TEST(Camera, ScreenRectHoldsEveryCorner) {
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

}  // namespace
}  // namespace grove::world
