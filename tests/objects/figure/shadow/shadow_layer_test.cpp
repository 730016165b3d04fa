#include "objects/figure/backend/shadow/shadow_layer.h"

#include <gtest/gtest.h>

#include <array>

#include "objects/figure/backend/shadow/contact_shadow.h"
#include "objects/figure/shadow/posts.h"
#include "objects/figure/shadow/sun_wall.h"
#include "objects/figure/shown_picture.h"

namespace grove::objects::figure {
namespace {

using world::Vec3;

/// Posts that stand in the sun.
class ShadowLayerTest : public testing::Test {
 protected:
  ShadowLayerTest() {
    sky_.sun = kSunOfWall;
    camera_.width = 320;
    camera_.height = 180;
    camera_.pose.position = {0.0F, 1.7F, 8.0F};
  }

  [[nodiscard]] std::optional<SunShadow> shadowOf(Vec3 place, const GroundSun& ground) const {
    const SunView view(sky_.sun);
    const raster::Surface post = makePost(kPostHeight, 0.4F);
    const std::array<world::Mat4, 1> bones{world::Mat4(1.0F)};
    const ShadowMask mask = castShadow(ShadowCaster(post), bones, view);
    return std::optional<SunShadow>(std::in_place, place, mask, view, ground, sky_, camera_);
  }

  [[nodiscard]] std::shared_ptr<raster::Image> emptyPicture(const world::Rect& rect) {
    auto image = pool_.acquire(rect);
    std::ranges::fill(image->colour, 0xFFFFFFFFU);
    std::ranges::fill(image->depth, 0.0F);
    image->spans.assign(static_cast<std::size_t>(rect.height()), raster::Span{});
    return image;
  }

  [[nodiscard]] Picture shown(Vec3 place) {
    const auto image = emptyPicture({0, 0, camera_.width, camera_.height});
    layShadows(place, shadowOf(place, ground_), camera_, *image);
    return Picture(*image);
  }

  /// Of the shadow of a point `height` metres above a place.
  [[nodiscard]] float shadeOf(const Picture& picture, Vec3 place, float height) const {
    const float plane = world::kShadowPlane;
    const Vec3 point = place + Vec3(0, plane, 0) + (height - plane) * world::shadowPerMetre(sky_.sun);
    return picture.shadeAt(camera_.project(point));
  }

  world::Sky sky_;
  world::Camera camera_;
  pipeline::MemoryLedger memory_;
  world::RayScene rays_{world::Triangles{}};
  GroundSun ground_{30.0F, kSunOfWall, {}, rays_, memory_};
  raster::ImagePool pool_;
};

/// Would catch a shadow on the wrong side, of the wrong length, beside its place, or above the ground.
TEST_F(ShadowLayerTest, LiesOnTheGroundBehindTheFigure) {
  const Vec3 place(0.5F, 0, 0);
  const Picture picture = shown(place);
  EXPECT_GT(shadeOf(picture, place, 0.3F * kPostHeight), 0.3F);
  EXPECT_GT(shadeOf(picture, place, 0.9F * kPostHeight), 0.2F);
  EXPECT_LT(shadeOf(picture, place, 1.15F * kPostHeight), 0.02F);
  EXPECT_LT(shadeOf(picture, place, -0.4F * kPostHeight), 0.02F);
  const float length = kPostHeight / kSunOfWall.y * std::hypot(kSunOfWall.x, kSunOfWall.z);
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      if (!isShade(picture.colour[picture.at(x, y)])) continue;
      const Vec3 ray = camera_.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const float depth = (world::kShadowPlane - camera_.pose.position.y) / ray.y;
      ASSERT_LT(picture.depth[picture.at(x, y)], depth) << "blades of grass would stick out of it";
      ASSERT_GT(picture.depth[picture.at(x, y)], depth - 1.51F);
      const Vec3 point = camera_.pose.position + depth * ray;
      ASSERT_NEAR(point.x, place.x, kShadowRadius + 0.05F);
      ASSERT_GT(point.z, place.z - kShadowRadius - 0.05F);
      ASSERT_LT(point.z, place.z + 1.1F * length);
    }
  }
}

/// Would catch shadows on ground that trees shade.
TEST_F(ShadowLayerTest, EndsWhereTheSunDoes) {
  const Vec3 place(0, 0, 0);
  EXPECT_GT(shadeOf(shown(place), place, 0.9F * kPostHeight), 0.2F);
  // From 2 metres before the post, a wall shades what is behind the post's own shadow.
  world::Triangles wall = sunWall(50.0F, 1.5F);
  for (Vec3& corner : wall.positions) corner.z += 1.5F;
  const world::RayScene rays(wall);
  const GroundSun shaded(30.0F, kSunOfWall, {}, rays, memory_);
  const auto image = emptyPicture({0, 0, camera_.width, camera_.height});
  layShadows(place, shadowOf(place, shaded), camera_, *image);
  const Picture picture(*image);
  EXPECT_LT(shadeOf(picture, place, 0.95F * kPostHeight), 0.02F);
  EXPECT_GT(shadeOf(picture, place, 0.25F * kPostHeight), 0.3F);
}

/// Would catch pixels beyond the picture's memory, and a shadow that depends on the picture's rectangle.
TEST_F(ShadowLayerTest, IsClippedToTheRectangle) {
  const Vec3 place(0, 0, 0);
  const Picture whole = shown(place);
  const world::Rect rect{158, 95, 171, 140};
  const auto image = emptyPicture(rect);
  layShadows(place, shadowOf(place, ground_), camera_, *image);
  const Picture part(*image);
  std::size_t shaded = 0;
  for (int y = rect.top; y < rect.bottom; ++y) {
    for (int x = rect.left; x < rect.right; ++x) {
      ASSERT_EQ(part.colour[part.at(x, y)], whole.colour[whole.at(x, y)]) << x << ' ' << y;
      if (isShade(part.colour[part.at(x, y)])) ++shaded;
    }
  }
  EXPECT_GT(shaded, 100U);
}

/// Would catch a shadow before the figure itself, and a light rim around the feet.
TEST_F(ShadowLayerTest, LiesBehindThePicture) {
  const Vec3 place(0, 0, 0);
  const Picture free = shown(place);
  const auto image = emptyPicture({0, 0, camera_.width, camera_.height});
  const Vec3 seen = camera_.project(place + Vec3(0, world::kShadowPlane, 0.5F));
  const auto row = static_cast<int>(seen.y);
  const auto column = static_cast<int>(seen.x);
  image->spans[static_cast<std::size_t>(row)] = {column, column + 2};
  image->colourRow(row)[column] = 0xFF102030U;
  image->colourRow(row)[column + 1] = 0x80081018U;
  for (const int x : {column, column + 1}) image->depthRow(row)[x] = 3.0F;
  layShadows(place, shadowOf(place, ground_), camera_, *image);
  const Picture picture(*image);
  EXPECT_EQ(picture.colour[picture.at(column, row)], 0xFF102030U);
  EXPECT_EQ(picture.depth[picture.at(column, row)], 3.0F);
  const std::uint32_t rim = picture.colour[picture.at(column + 1, row)];
  const std::uint32_t behind = free.colour[free.at(column + 1, row)] >> 24U;
  EXPECT_NEAR(static_cast<double>(rim & 0xFFU), 24.0, 2.0) << "it gets nothing but the shade's own colour";
  EXPECT_NEAR(static_cast<double>(rim >> 24U), 128.0 + 127.0 * behind / 255.0, 1.5);
}

/// Would catch feet that stand in a black hole where both shadows meet.
TEST_F(ShadowLayerTest, ContactAndSunAreNotAddedUp) {
  const Vec3 place(0, 0, 0);
  const Picture both = shown(place);
  const auto image = emptyPicture({0, 0, camera_.width, camera_.height});
  layShadows(place, std::nullopt, camera_, *image);
  const Picture contact(*image);
  std::uint32_t darkest = 0;
  for (std::size_t i = 0; i < both.colour.size(); ++i) {
    ASSERT_GE(both.colour[i] >> 24U, contact.colour[i] >> 24U);
    darkest = std::max(darkest, both.colour[i] >> 24U);
  }
  EXPECT_LT(darkest, 200U);
}

/// Sum of the ground that is shaded, weighted by opacity. Square metres.
double shadedArea(const Picture& picture, const world::Camera& camera) {
  double area = 0.0;
  for (int y = camera.height / 2 + 1; y < camera.height; ++y) {
    const auto row = GroundRows(0.0F, camera).at(static_cast<float>(y) + 0.5F);
    if (!row) continue;
    for (int x = 0; x < camera.width; ++x) {
      area += static_cast<double>((picture.colour[picture.at(x, y)] >> 24U) / 255.0F * glm::length(row->step) *
                                  row->length);
    }
  }
  return area;
}

/// Would catch a shadow that loses its thin parts in small pictures.
TEST_F(ShadowLayerTest, IsTheSameAtEverySize) {
  sky_.sun = glm::normalize(Vec3(-1.0F, 0.25F, -0.1F));
  const auto areaAt = [&](int lines, float distance) {
    camera_.width = lines * 16 / 9;
    camera_.height = lines;
    camera_.pose.position.z = distance;
    return shadedArea(shown({-3.0F, 0, 0}), camera_);
  };
  for (const float distance : {8.0F, 20.0F}) {
    const double fine = areaAt(720, distance);
    EXPECT_GT(fine, 0.3) << distance;
    EXPECT_NEAR(areaAt(360, distance) / fine, 1.0, 0.1) << distance;
    EXPECT_NEAR(areaAt(480, distance) / fine, 1.0, 0.1) << distance;
  }
}

/// Would catch a shadow thinner than a row of pixels that comes and goes as the head nods.
TEST_F(ShadowLayerTest, DoesNotFlickerFarAway) {
  sky_.sun = glm::normalize(Vec3(-1.0F, 0.25F, 0.0F));
  camera_.width = 640;
  camera_.height = 360;
  camera_.pose.position.z = 25.0F;
  const Vec3 place(-3.0F, 0, 0);
  const double before = shadedArea(shown(place), camera_);
  EXPECT_GT(before, 0.3);
  constexpr float kQuarterOfAPixel = 0.0008F;
  for (int step = 1; step < 8; ++step) {
    camera_.pose.pitch = -kQuarterOfAPixel * static_cast<float>(step);
    EXPECT_NEAR(shadedArea(shown(place), camera_) / before, 1.0, 0.15) << step;
  }
}

/// Would catch shadows that are blacker than anything else in the mist, and those that vanish at once.
TEST_F(ShadowLayerTest, FadesWithTheDistance) {
  const Vec3 place(0, 0, 0);
  float before = 1.0F;
  for (const float distance : {6.0F, 12.0F, 20.0F, 28.0F, 36.0F, 42.0F}) {
    ASSERT_LT(distance, SunShadow::kFarthest);
    camera_.pose.position.z = distance;
    camera_.pose.position.y = 0.3F * distance;
    camera_.pose.pitch = -0.29F;
    const float shade = shadeOf(shown(place), place, 0.5F * kPostHeight);
    EXPECT_LT(shade, before) << distance;
    EXPECT_GT(shade, 0.0F) << distance;
    before = shade;
  }
  EXPECT_LT(before, 0.15F);
}

}  // namespace
}  // namespace grove::objects::figure
