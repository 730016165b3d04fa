#include "objects/figure/backend/shadow/shadow_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "objects/figure/backend/figure_shape.h"
#include "objects/figure/backend/gait.h"
#include "objects/figure/backend/shadow/shadow_grid.h"
#include "objects/figure/shadow/posts.h"

namespace grove::objects::figure {
namespace {

using world::Vec2;
using world::Vec3;

ShadowMask shadowOfPost(const SunView& sun) {
  const raster::Surface post = makePost(kPostHeight, 0.2F);
  const std::array<world::Mat4, 1> bones{world::Mat4(1.0F)};
  return castShadow(ShadowCaster(post), bones, sun);
}

/// Would catch a shadow on the sun's side, and one that is not as long as the sun is low.
TEST(ShadowMask, ReachesHeightOverTangentAwayFromTheSun) {
  for (const float slope : {0.188F, 0.5F, 1.5F}) {
    const SunView sun(glm::normalize(Vec3(-0.6F, slope, -0.8F)));
    const ShadowMask mask = shadowOfPost(sun);
    const Vec3 away(0.6F, 0.0F, 0.8F);
    const float length = kPostHeight / slope;
    EXPECT_GT(opacityAt(mask, sun.of(0.5F * length * away)), 0.7F) << slope;
    EXPECT_GT(opacityAt(mask, sun.of(0.93F * length * away)), 0.4F) << slope;
    EXPECT_LT(opacityAt(mask, sun.of(1.2F * length * away)), 0.1F) << slope;
    EXPECT_EQ(opacityAt(mask, sun.of(-0.3F * length * away)), 0.0F) << slope;
    EXPECT_EQ(opacityAt(mask, sun.of(0.5F * length * away + Vec3(0.8F, 0.0F, -0.6F))), 0.0F) << slope;
  }
}

/// Width in metres of the edge from nearly no shadow to nearly whole shadow, relative to the darkest place.
float edgeAt(const ShadowMask& mask, float height) {
  const float darkest = opacityAt(mask, {0.0F, height});
  int soft = 0;
  for (int millimetre = 0; millimetre < 600; ++millimetre) {
    const float share = opacityAt(mask, {0.001F * static_cast<float>(millimetre), height}) / darkest;
    if (share > 0.1F && share < 0.9F) ++soft;
  }
  return 0.001F * static_cast<float>(soft);
}

/// Would catch hard edges, and a shadow that is as soft at the feet as at the head.
TEST(ShadowMask, IsSofterTheFartherFromTheFeet) {
  const ShadowMask mask = shadowOfPost(SunView(glm::normalize(Vec3(0.0F, 0.188F, -1.0F))));
  EXPECT_GT(edgeAt(mask, 0.2F), 0.015F);
  EXPECT_LT(edgeAt(mask, 0.2F), 0.07F);
  EXPECT_GT(edgeAt(mask, 1.5F), 2.0F * edgeAt(mask, 0.2F));
}

/// Would catch a figure with an open part, where the triangles that face the sun leave a hole in the shadow: those of
/// the other side must cover the same.
TEST(ShadowMask, BothSidesOfAFigureCastTheSameShadow) {
  const raster::Surface figure = makeFigure(1.0F).surface;
  raster::Surface reversed = figure;
  for (raster::Level& level : reversed.levels) {
    for (raster::Triangle& triangle : level.triangles) std::swap(triangle[1], triangle[2]);
  }
  world::Player player;
  player.velocity.x = world::kWalkSpeed;
  for (int step = 0; step < 8; ++step) {
    player.stride = 0.19F * static_cast<float>(step);
    world::Transform transform;
    transform.yaw = 0.8F * static_cast<float>(step);
    const auto bones = bonesOf(player, transform);
    const SunView sun(glm::normalize(Vec3(0.5F, 0.2F + 0.2F * static_cast<float>(step), 0.3F)));
    const ShadowMask front = castShadow(ShadowCaster(figure), bones, sun);
    const ShadowMask back = castShadow(ShadowCaster(reversed), bones, sun);
    int different = 0;
    for (std::size_t i = 0; i < front.opacity.size(); ++i) {
      if (std::abs(front.opacity[i] - back.opacity[i]) > 32) ++different;
    }
    EXPECT_EQ(different, 0) << step;
    EXPECT_GT(std::ranges::count_if(front.opacity, [](int opacity) { return opacity > 200; }), 300);
  }
}

/// Would catch a shadow that ends in a straight line where its mask ends.
TEST(ShadowMask, FadesOutBeforeItsEnds) {
  for (const float slope : {0.188F, 1.0F}) {
    const ShadowMask mask = shadowOfPost(SunView(glm::normalize(Vec3(0.3F, slope, -0.9F))));
    for (std::size_t row = 0; row < kShadowRows; ++row) {
      for (std::size_t column = 0; column < kShadowColumns; ++column) {
        const bool isEnd = row == 0 || row + 1 == kShadowRows || column == 0 || column + 1 == kShadowColumns;
        if (isEnd) {
          ASSERT_EQ(mask.opacity[row * kShadowColumns + column], 0) << row << ' ' << column;
        }
      }
    }
  }
}

}  // namespace
}  // namespace grove::objects::figure
