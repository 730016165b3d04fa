#include "objects/lightfield/format/view_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "objects/lightfield/format/view_sphere.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

const ViewGeometry kGeometry{{0.2F, 0.0F, -0.1F}, 5.0F, {0.0F, 1.5F, 0.0F}, 1.7F};

TEST(ViewCamera, IsOrthonormalAndNotMirrored) {
  const ViewSphere sphere(9);
  for (int view = 0; view < sphere.views(); ++view) {
    const ViewCamera camera = viewCamera(kGeometry, sphere.direction(view));
    EXPECT_NEAR(glm::length(camera.right), 1.0F, 1e-5F);
    EXPECT_NEAR(glm::length(camera.down), 1.0F, 1e-5F);
    EXPECT_NEAR(glm::dot(camera.right, camera.down), 0.0F, 1e-4F);
    EXPECT_NEAR(glm::dot(camera.right, camera.forward), 0.0F, 1e-4F);
    EXPECT_NEAR(glm::distance(glm::cross(camera.right, camera.down), camera.forward), 0.0F, 1e-4F);
    EXPECT_LE(camera.down.y, 1e-4F);
    EXPECT_NEAR(glm::distance(camera.eye, kGeometry.centre), kGeometry.radius, 1e-4F);
  }
}

/// The ball around the target touches the picture's edges and no more, and lies between near and far.
TEST(ViewCamera, ContainsTheBall) {
  const ViewSphere sphere(6);
  for (int view = 0; view < sphere.views(); ++view) {
    const ViewCamera camera = viewCamera(kGeometry, sphere.direction(view));
    float furthest = 0.0F;
    for (int a = 0; a < 64; ++a) {
      for (int b = -31; b <= 31; ++b) {
        const float s = static_cast<float>(a) * 0.0981748F;
        const float t = static_cast<float>(b) * 0.05F;
        const Vec3 onBall(std::cos(s) * std::cos(t), std::sin(t), std::sin(s) * std::cos(t));
        const Vec3 p = kGeometry.target + kGeometry.extent * onBall - camera.eye;
        const float depth = glm::dot(camera.forward, p);
        EXPECT_GE(depth, camera.nearDepth - 1e-4F);
        EXPECT_LE(depth, camera.farDepth + 1e-4F);
        furthest = std::max(furthest, camera.focal * std::abs(glm::dot(camera.right, p)) / depth);
      }
    }
    EXPECT_LE(furthest, 0.5001F);
    EXPECT_GE(furthest, 0.49F);
  }
}

TEST(ViewCamera, ObjectCameraSeesTheSame) {
  constexpr int kSize = 64;
  const ViewCamera camera = viewCamera(kGeometry, glm::normalize(Vec3(0.3F, 0.5F, -0.7F)));
  const ObjectCamera rays = objectCamera(camera, kSize);
  for (const world::Vec2 pixel : {world::Vec2(0.5F, 0.5F), world::Vec2(63.5F, 7.5F), world::Vec2(32.0F, 50.5F)}) {
    constexpr float kDepth = 4.2F;
    const Vec3 p = rays.eye + kDepth * rays.ray(pixel.x, pixel.y) - camera.eye;
    const float depth = glm::dot(camera.forward, p);
    EXPECT_NEAR(depth, kDepth, 1e-4F);
    EXPECT_NEAR(kSize * (0.5F + camera.focal * glm::dot(camera.right, p) / depth), pixel.x, 1e-3F);
    EXPECT_NEAR(kSize * (0.5F + camera.focal * glm::dot(camera.down, p) / depth), pixel.y, 1e-3F);
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
