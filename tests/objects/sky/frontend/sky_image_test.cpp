#include "objects/sky/frontend/sky_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "objects/sky/backend/panorama_bake.h"
#include "world/sky.h"

namespace grove::objects::sky {
namespace {

world::Camera cameraAt(float yaw, float pitch) {
  return {.pose = {.yaw = yaw, .pitch = pitch}, .width = 322, .height = 181};
}

world::Rect whole(const world::Camera& camera) { return {0, 0, camera.width, camera.height}; }

class SkyImage : public testing::Test {
 protected:
  static inline const world::Sky sky;
  static void SetUpTestSuite() {
    baked = std::make_unique<SkyMaps>(bakePanorama({1024, 256}, 7, sky, [](float) {}));
  }
  static void TearDownTestSuite() { baked.reset(); }
  static inline std::unique_ptr<SkyMaps> baked;
  raster::ImagePool images;
};

TEST_F(SkyImage, SunAppearsInItsDirection) {
  for (const float turn : {0.0F, 0.4F, -0.5F}) {
    const world::Vec3 sun = world::Sky().sun;
    const world::Camera camera = cameraAt(std::atan2(-sun.x, -sun.z) + turn, 0.15F);
    const auto image = skyImage(*baked, sky.sun, camera, whole(camera), images);
    ASSERT_TRUE(image);
    const world::Vec3 at = camera.project(camera.pose.position + sun);
    const std::uint32_t there = image->colourRow(static_cast<int>(at.y))[static_cast<int>(at.x)];
    EXPECT_GE(there & 0xFFU, 245U);
    EXPECT_GE((there >> 8U) & 0xFFU, 235U);
    const std::uint32_t away = image->colourRow(2)[static_cast<int>(at.x) < 160 ? 315 : 5];
    EXPECT_LT((away >> 8U) & 0xFFU, 225U);
  }
}

TEST_F(SkyImage, LiesBehindEverything) {
  const world::Camera camera = cameraAt(1.0F, 0.3F);
  const auto image = skyImage(*baked, sky.sun, camera, whole(camera), images);
  ASSERT_TRUE(image);
  for (const float depth : image->depth) ASSERT_EQ(depth, world::kInfiniteDepth);
}

TEST_F(SkyImage, EndsSlightlyBelowTheHorizon) {
  const world::Camera level = cameraAt(2.0F, 0.0F);
  const auto image = skyImage(*baked, sky.sun, level, whole(level), images);
  ASSERT_TRUE(image);
  EXPECT_GT(image->rect.bottom, 90);
  EXPECT_LT(image->rect.bottom, 100);
  const world::Camera down = cameraAt(2.0F, -1.2F);
  EXPECT_FALSE(skyImage(*baked, sky.sun, down, whole(down), images));
}

TEST_F(SkyImage, PartEqualsTheWhole) {
  const world::Camera camera = cameraAt(-2.5F, 0.4F);
  const auto all = skyImage(*baked, sky.sun, camera, whole(camera), images);
  for (const world::Rect rect :
       {world::Rect{37, 11, 200, 90}, world::Rect{100, 24, 101, 25}, world::Rect{0, 120, 322, 181}}) {
    const auto part = skyImage(*baked, sky.sun, camera, rect, images);
    ASSERT_TRUE(part);
    for (int y = part->rect.top; y < part->rect.bottom; ++y) {
      for (int x = rect.left; x < rect.right; ++x) {
        ASSERT_EQ(part->colourRow(y - part->rect.top)[x - rect.left], all->colourRow(y)[x]) << x << ", " << y;
      }
    }
  }
}

/// Fails if columns left of the frame are rounded towards it.
TEST_F(SkyImage, BorderChangesNothing) {
  const world::Camera camera = cameraAt(-2.5F, 0.4F);
  const auto all = skyImage(*baked, sky.sun, camera, whole(camera), images);
  for (const world::Rect border : {world::Rect{-2, -2, 324, 182}, world::Rect{-38, -14, 330, 190}}) {
    const auto wide = skyImage(*baked, sky.sun, camera, border, images);
    ASSERT_TRUE(wide);
    for (int y = all->rect.top; y < all->rect.bottom; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        ASSERT_EQ(wide->colourRow(y - border.top)[x - border.left], all->colourRow(y)[x]) << x << ", " << y;
      }
    }
    EXPECT_NE(wide->colourRow(0)[0] & 0xFFFFFFU, 0U) << "the border is not black";
  }
}

TEST_F(SkyImage, IsSmoothAtSeamAndZenith) {
  // Heading 0 is the map's seam; the pitch shows the zenith.
  for (const float pitch : {0.5F, 1.45F}) {
    const world::Camera camera = cameraAt(0.0F, pitch);
    const auto image = skyImage(*baked, sky.sun, camera, whole(camera), images);
    ASSERT_TRUE(image);
    for (int y = 0; y < 60; ++y) {
      for (int x = 1; x < camera.width; ++x) {
        const auto blue = [&](int at) { return static_cast<int>((image->colourRow(y)[at] >> 16U) & 0xFFU); };
        ASSERT_LE(std::abs(blue(x) - blue(x - 1)), 24) << x << ", " << y << " pitch " << pitch;
      }
    }
  }
}

}  // namespace
}  // namespace grove::objects::sky
