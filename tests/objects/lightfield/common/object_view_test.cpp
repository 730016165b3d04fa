#include "objects/lightfield/common/object_view.h"

#include <gtest/gtest.h>

#include "world/light.h"
#include "world/sky.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

LightField fieldOf(int size) {
  LightField field;
  field.sphere = ViewSphere(4);
  field.geometry = {{0, 0, 0}, 8.0F, {0, 2, 0}, 3.0F};
  field.size = size;
  field.levels = 4;
  return field;
}

world::Camera cameraAt(Vec3 position) {
  world::Camera camera;
  camera.pose.position = position;
  camera.pose.yaw = 0.3F;
  camera.pose.pitch = -0.1F;
  return camera;
}

TEST(ObjectView, PixelPointAgreesInBothCoordinates) {
  const world::Transform transform{{3, 0.5F, -2}, 1.1F, 1.7F};
  const world::Camera camera = cameraAt({1, 1.7F, 9});
  const ObjectCamera object = objectCamera(camera, transform);
  for (const auto& [x, y, depth] : {std::array{0.5F, 0.5F, 3.0F}, {640.5F, 300.5F, 11.0F}, {1279.5F, 719.5F, 25.0F}}) {
    const Vec3 inWorld = camera.pose.position + depth * camera.ray(x, y);
    const Vec3 inObject = object.eye + depth * object.ray(x, y);
    const Vec3 moved(transform.matrix() * world::Vec4(inObject, 1.0F));
    EXPECT_NEAR(glm::distance(moved, inWorld), 0.0F, 1e-4F);
  }
}

TEST(ObjectView, TwiceAsFarIsOneLevelCoarser) {
  const LightField field = fieldOf(512);
  const auto level = [&](float metres, float scale) {
    const world::Transform transform{{0, 0, 0}, 0.0F, scale};
    return levelFor(field, objectCamera(cameraAt({0, 2.0F * scale, metres}), transform));
  };
  EXPECT_EQ(level(4.0F, 1.0F), 0);
  EXPECT_EQ(level(64.0F, 1.0F), level(32.0F, 1.0F) + 1);
  EXPECT_EQ(level(5000.0F, 1.0F), field.levels - 1);
  EXPECT_EQ(level(64.0F, 2.0F), level(32.0F, 1.0F));
}

TEST(ObjectView, ChosenLevelMatchesPixels) {
  const LightField field = fieldOf(512);
  for (int distance = 20; distance < 60; distance += 3) {
    const auto metres = static_cast<float>(distance);
    const world::Camera camera = cameraAt({0, 2, metres});
    const int level = levelFor(field, objectCamera(camera, {}));
    const float texelMetres = 2.0F * field.geometry.extent / static_cast<float>(field.size >> level);
    const float pixelMetres = metres / camera.focal();
    EXPECT_LT(texelMetres, 1.45F * pixelMetres) << metres;
    EXPECT_GT(texelMetres, 0.55F * pixelMetres) << metres;
  }
}

TEST(ObjectView, BoxIsWithinItsPixels) {
  const ViewCamera view = viewCamera(fieldOf(512).geometry, glm::normalize(Vec3(1, 0.5F, 2)));
  const ObjectCamera camera = objectCamera(view, 400);
  const world::Rect whole{0, 0, 400, 400};
  const world::Bounds flat{{-2, 0, -2}, {2, 0.5F, 2}};
  const world::Rect rect = boxOf(flat, camera, whole);
  EXPECT_LT(rect.width() * rect.height(), 400 * 400 / 3);
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) {
      const Vec3 ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const float depth = (0.25F - camera.eye.y) / ray.y;
      const Vec3 point = camera.eye + depth * ray;
      if (depth < 0.0F || std::max(std::abs(point.x), std::abs(point.z)) > 2.0F) continue;
      EXPECT_TRUE(x >= rect.left && x < rect.right && y >= rect.top && y < rect.bottom) << x << ' ' << y;
    }
  }
  EXPECT_EQ(boxOf({{-20, -20, -20}, {20, 20, 20}}, camera, whole), whole);
}

TEST(ObjectView, HazeMatchesTheWorld) {
  const world::Bounds bounds{{-1, 0, -101}, {1, 2, -99}};
  const world::Camera camera = cameraAt({0, 1, 0});
  const Haze haze = hazeBefore(bounds, world::Sky(), camera);
  EXPECT_NEAR(haze.amount, world::hazeAmount(100.0F), 1e-4F);
  EXPECT_NEAR(haze.colour[0], world::toDisplay(world::Sky().hazeColour({0, 0, -1}).r), 1e-4F);
}

/// Fails if an object's size counts, which makes magnification() less than this.
TEST(TexelWidth, IsThatOfTheMiddle) {
  const ViewGeometry geometry = fieldOf(8).geometry;
  const ObjectCamera camera = objectCamera(cameraAt({0.0F, 2.0F, 12.0F}), {});
  const float width = texelWidth(geometry, 8, camera);
  EXPECT_GT(width, 1.0F);
  EXPECT_NEAR(texelWidth(geometry, 16, camera), 0.5F * width, 0.01F * width);
  EXPECT_NEAR(texelWidth(geometry, 8, objectCamera(cameraAt({0.0F, 2.0F, 24.0F}), {})), 0.5F * width, 0.01F * width);
  EXPECT_NEAR(magnification(geometry, 8, camera), width * 12.0F / 13.5F, 0.01F * width);
}

}  // namespace
}  // namespace grove::objects::lightfield
