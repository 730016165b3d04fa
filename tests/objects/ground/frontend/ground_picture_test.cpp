#include "objects/ground/frontend/ground_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "objects/ground/backend/meadow_bake.h"
#include "world/sky.h"

namespace grove::objects::ground {
namespace {

Clearing uniform(float grass) {
  return {Pyramid(64, std::vector<std::uint32_t>(64 * 64, packTexel(1.0F, 1.0F, 0.5F, grass))), 40.0F};
}

GroundMaps mapsWith(float grass) { return {uniform(grass), bakeMeadow(128, 2.0F, 3)}; }

world::Camera cameraAt(world::Vec3 eye, float pitch) {
  return {.pose = {.position = eye, .yaw = 0.6F, .pitch = pitch}, .width = 330, .height = 181};
}

world::Rect whole(const world::Camera& camera) { return {0, 0, camera.width, camera.height}; }

/// The last part first, as threads may have it.
std::shared_ptr<const raster::Image> groundImage(const GroundMaps& maps, const world::Camera& camera,
                                                 const world::Rect& rect, std::span<const world::PointLight> lights,
                                                 raster::ImagePool& images) {
  const GroundLight light{world::Sky()};
  GroundPicture picture(maps, light, camera, rect, lights, images);
  for (std::size_t part = picture.parts(); part > 0; --part) picture.paint(part - 1);
  return picture.image();
}

class GroundPictureTest : public testing::Test {
 protected:
  const GroundMaps bare = mapsWith(0.0F);
  const GroundMaps grown = mapsWith(0.9F);
  raster::ImagePool images;
};

TEST_F(GroundPictureTest, BareEarthHasPlaneDepth) {
  for (const float pitch : {-0.1F, -0.7F, -1.45F}) {
    const world::Camera camera = cameraAt({3.0F, 1.7F, -2.0F}, pitch);
    const auto image = groundImage(bare, camera, whole(camera), {}, images);
    ASSERT_TRUE(image);
    for (int y = image->rect.top; y < image->rect.bottom; ++y) {
      for (const int x : {0, 17, 255, 256, 329}) {
        const world::Vec3 ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        const float exact = -1.7F / ray.y;
        // Towards the horizon a row of the image spans many metres, and rounding with it.
        ASSERT_NEAR(image->depthRow(y - image->rect.top)[x], exact, 2e-4F * exact * exact + 1e-3F) << x << ", " << y;
      }
    }
  }
}

/// Fails if a hill is drawn beside its place, or if what it hides is visible. At the edge of a crest, pixels lie
/// between.
TEST_F(GroundPictureTest, HillsHaveTheirDepth) {
  GroundMaps hilly = bare;
  hilly.hills = {{{-4.0F, -9.0F}, 8.0F, 1.2F}, {{2.0F, -30.0F}, 12.0F, 1.0F}};
  const world::Camera camera = cameraAt({0.0F, 1.7F, 3.0F}, -0.1F);
  const auto image = groundImage(hilly, camera, whole(camera), {}, images);
  ASSERT_TRUE(image);
  const auto heightAbove = [&](world::Vec3 point) {
    return point.y - world::groundHeight(hilly.hills, {point.x, point.z});
  };
  int strayed = 0;
  int onHills = 0;
  for (int y = image->rect.top; y < image->rect.bottom; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const world::Vec3 ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const auto at = [&](float depth) { return camera.pose.position + depth * ray; };
      const float depth = image->depthRow(y - image->rect.top)[x];
      bool isHidden = false;
      for (int share = 1; share < 20; ++share) {
        isHidden = isHidden || heightAbove(at(depth * 0.048F * static_cast<float>(share))) < -0.03F;
      }
      const float above = heightAbove(at(depth));
      if (isHidden || std::abs(above) > 0.03F + 2e-3F * depth) ++strayed;
      if (above < 0.1F && at(depth).y > 0.2F) ++onHills;
    }
  }
  EXPECT_GT(onHills, 3000);
  EXPECT_LT(strayed, image->height() * camera.width / 100);
}

TEST_F(GroundPictureTest, GrassIsNearerThanThePlane) {
  const world::Camera camera = cameraAt({0.0F, 1.7F, 0.0F}, -0.2F);
  const auto image = groundImage(grown, camera, whole(camera), {}, images);
  ASSERT_TRUE(image);
  int standing = 0;
  for (int y = image->rect.top; y < image->rect.bottom; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const world::Vec3 ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const float plane = -1.7F / ray.y;
      const float depth = image->depthRow(y - image->rect.top)[x];
      ASSERT_LE(depth, plane * 1.01F + 0.01F);
      const float height = 1.7F + depth * ray.y;
      ASSERT_LE(height, kTallest + 0.05F) << x << ", " << y;
      if (height > 0.03F) ++standing;
    }
  }
  EXPECT_GT(standing, camera.width * image->height() / 4);
}

TEST_F(GroundPictureTest, IsOpaqueAndBeginsBelowTheHorizon) {
  const world::Camera camera = cameraAt({0.0F, 1.7F, 0.0F}, 0.0F);
  const auto image = groundImage(grown, camera, whole(camera), {}, images);
  ASSERT_TRUE(image);
  EXPECT_GE(image->rect.top, 90);
  EXPECT_LE(image->rect.top, 94);
  EXPECT_EQ(image->rect.bottom, 181);
  for (const std::uint32_t colour : image->colour) ASSERT_EQ(colour >> 24U, 0xFFU);
}

TEST_F(GroundPictureTest, EmptyFromBelowAndLookingUp) {
  const world::Camera under = cameraAt({0.0F, -0.5F, 0.0F}, -0.3F);
  EXPECT_FALSE(groundImage(grown, under, whole(under), {}, images));
  const world::Camera on = cameraAt({0.0F, 0.0F, 0.0F}, -0.3F);
  EXPECT_FALSE(groundImage(grown, on, whole(on), {}, images));
  GroundMaps hilly = grown;
  hilly.hills = {{{1.0F, 0.0F}, 10.0F, 1.0F}};
  const world::Camera inside = cameraAt({0.0F, 0.5F, 0.0F}, -0.3F);
  EXPECT_FALSE(groundImage(hilly, inside, whole(inside), {}, images));
  const world::Camera up = cameraAt({0.0F, 1.7F, 0.0F}, 0.9F);
  EXPECT_FALSE(groundImage(grown, up, whole(up), {}, images));
}

TEST_F(GroundPictureTest, PartEqualsTheWhole) {
  const world::Camera camera = cameraAt({1.0F, 1.7F, 5.0F}, -0.3F);
  const auto all = groundImage(grown, camera, whole(camera), {}, images);
  for (const world::Rect rect :
       {world::Rect{37, 101, 300, 140}, world::Rect{257, 60, 258, 181}, world::Rect{0, 0, 10, 70}}) {
    const auto part = groundImage(grown, camera, rect, {}, images);
    ASSERT_TRUE(part);
    for (int y = part->rect.top; y < part->rect.bottom; ++y) {
      for (int x = rect.left; x < rect.right; ++x) {
        const int row = y - all->rect.top;
        ASSERT_EQ(part->colourRow(y - part->rect.top)[x - rect.left], all->colourRow(row)[x]) << x << ", " << y;
        ASSERT_EQ(part->depthRow(y - part->rect.top)[x - rect.left], all->depthRow(row)[x]) << x << ", " << y;
      }
    }
  }
}

/// Fails if columns left of the frame are rounded towards it.
TEST_F(GroundPictureTest, BorderChangesNothing) {
  const world::Camera camera = cameraAt({3.0F, 1.7F, -2.0F}, -0.3F);
  const auto all = groundImage(grown, camera, whole(camera), {}, images);
  const world::Rect border{-38, -14, 360, 200};
  const auto wide = groundImage(grown, camera, border, {}, images);
  ASSERT_TRUE(all && wide);
  for (int y = all->rect.top; y < all->rect.bottom; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const std::uint32_t there = wide->colourRow(y - wide->rect.top)[x - border.left];
      ASSERT_EQ(there, all->colourRow(y - all->rect.top)[x]) << x << ", " << y;
    }
  }
}

TEST_F(GroundPictureTest, LampsBrightenTheGroundBelow) {
  const world::Camera camera = cameraAt({0.0F, 1.7F, 0.0F}, -0.5F);
  const world::Vec3 spot = camera.pose.position + camera.ray(165.0F, 100.0F) * (-1.7F / camera.ray(165.0F, 100.0F).y);
  const std::array<world::PointLight, 1> lamp{{{spot + world::Vec3(0, 0.8F, 0), {3.0F, 1.5F, 0.5F}}}};
  const auto dark = groundImage(bare, camera, whole(camera), {}, images);
  const auto lit = groundImage(bare, camera, whole(camera), lamp, images);
  const auto gain = [&](int x, int y) {
    const auto red = [&](const raster::Image& image) {
      return static_cast<int>(image.colourRow(y - image.rect.top)[x] & 0xFFU);
    };
    return red(*lit) - red(*dark);
  };
  EXPECT_GT(gain(165, 100), 40);
  EXPECT_GT(gain(165, 100), 4 * gain(5, 180));
  EXPECT_GE(gain(5, 180), 0);
}

TEST_F(GroundPictureTest, UsesTheNearestEightLamps) {
  const world::Camera camera = cameraAt({0.0F, 1.7F, 0.0F}, -0.5F);
  std::vector<world::PointLight> lamps(8, {{0.0F, 1.0F, -1.0F}, {0.1F, 0.1F, 0.1F}});
  const auto without = groundImage(grown, camera, whole(camera), lamps, images);
  lamps.insert(lamps.begin(), {{0.0F, 1.0F, 25.0F}, {50.0F, 50.0F, 50.0F}});
  const auto with = groundImage(grown, camera, whole(camera), lamps, images);
  EXPECT_TRUE(std::ranges::equal(without->colour, with->colour));
}

/// Sum of squared differences of green from a picture four times as fine, averaged. Fails if pixels show one texel
/// each.
TEST_F(GroundPictureTest, LooksLikeTheMeanOfFinerPixels) {
  constexpr int kFiner = 4;
  const world::Camera camera = cameraAt({1.0F, 1.7F, 5.0F}, -0.5F);
  world::Camera fine = camera;
  fine.width *= kFiner;
  fine.height *= kFiner;
  const auto image = groundImage(grown, camera, whole(camera), {}, images);
  const auto truth = groundImage(grown, fine, whole(fine), {}, images);
  const auto green = [](std::uint32_t colour) { return static_cast<int>(colour >> 8U & 0xFFU); };
  double sum = 0.0;
  int count = 0;
  for (int y = image->rect.top + 1; y < image->rect.bottom - 1; ++y) {
    for (int x = 1; x < camera.width - 1; ++x) {
      int mean = 0;
      for (int i = 0; i < kFiner * kFiner; ++i) {
        const int row = y * kFiner + i / kFiner - truth->rect.top;
        mean += green(truth->colourRow(row)[x * kFiner + i % kFiner]);
      }
      const double off = green(image->colourRow(y - image->rect.top)[x]) - mean / double{kFiner * kFiner};
      sum += off * off;
      ++count;
    }
  }
  EXPECT_LT(sum / count, 100.0);
}

}  // namespace
}  // namespace grove::objects::ground
