#include "objects/figure/backend/shadow/shadow_masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "objects/figure/backend/figure_shape.h"
#include "objects/figure/backend/gait.h"
#include "objects/figure/backend/shadow/shadow_grid.h"
#include "objects/figure/shadow/posts.h"
#include "world/ground/ground_shadow.h"
#include "world/sky.h"

namespace grove::objects::figure {
namespace {

using world::Vec3;

class ShadowMasksTest : public testing::Test {
 protected:
  static std::vector<raster::LitSurface> makeAll() {
    std::vector<raster::LitSurface> all;
    all.reserve(kStatures.size());
    for (const Stature& stature : kStatures) all.push_back(makeFigure(stature.breadth));
    return all;
  }

  static world::Player walker(world::PlayerId id, float yaw, float stride) {
    world::Player player;
    player.id = id;
    player.pose.yaw = yaw;
    player.stride = stride;
    player.velocity = {0, 0, -world::kWalkSpeed};
    return player;
  }

  [[nodiscard]] std::int64_t bytes() const { return memory_.totals().at({"shadows", "figure"}).bytes; }

  const std::vector<raster::LitSurface> figures_ = makeAll();
  const Vec3 sun_ = world::Sky().sun;
  pipeline::MemoryLedger memory_;
  ShadowMasks masks_{figures_, 1.0F, sun_, memory_};
};

/// Would catch a shadow that is made anew for each viewer.
TEST_F(ShadowMasksTest, ViewersShareThem) {
  const auto mask = masks_.of(ShadowPose::of(walker(1, 0.3F, 2.0F)));
  EXPECT_EQ(mask, masks_.of(ShadowPose::of(walker(1, 0.3F, 2.0F))));
  EXPECT_EQ(mask, masks_.of(ShadowPose::of(walker(1 + kStatures.size(), 0.3F, 2.0F + kStrideMetres))));
  EXPECT_NE(mask, masks_.of(ShadowPose::of(walker(2, 0.3F, 2.0F)))) << "a taller one";
  EXPECT_NE(mask, masks_.of(ShadowPose::of(walker(1, 1.3F, 2.0F)))) << "who looks elsewhere";
  EXPECT_NE(mask, masks_.of(ShadowPose::of(walker(1, 0.3F, 2.4F)))) << "who has made half a step";
}

/// Would catch a busy machine that makes as many shadows as one that has time, and poses that nobody has.
TEST_F(ShadowMasksTest, BusyMachinesShareMore) {
  std::set<ShadowPose> fine;
  std::set<ShadowPose> coarse;
  for (int i = 0; i < 600; ++i) {
    const auto step = static_cast<float>(i);
    const world::Player player = walker(1, 0.011F * step, 0.03F * step);
    fine.insert(ShadowPose::of(player));
    const ShadowPose pose = ShadowPose::of(player, ShadowPose::Steps::kCoarse);
    coarse.insert(pose);
    const auto isNear = [](int a, int b, int steps) { return (a - b + steps + 1) % steps <= 2; };
    EXPECT_TRUE(isNear(pose.yaw, ShadowPose::of(player).yaw, ShadowPose::kYaws)) << i;
    EXPECT_TRUE(isNear(pose.phase, ShadowPose::of(player).phase, ShadowPose::kPhases)) << i;
    EXPECT_LT(pose.yaw, ShadowPose::kYaws);
    EXPECT_LT(pose.phase, ShadowPose::kPhases);
    EXPECT_EQ(pose.pace, ShadowPose::kPaces);
  }
  EXPECT_LT(10 * coarse.size(), 7 * fine.size());
}

/// Would catch shadows that take memory for as long as the world lives.
TEST_F(ShadowMasksTest, AreBounded) {
  ShadowPose pose;
  std::int64_t most = 0;
  for (std::size_t i = 0; i < ShadowMasks::kMost + 120; ++i) {
    pose.yaw = static_cast<int>(i) % ShadowPose::kYaws;
    pose.phase = static_cast<int>(i) / ShadowPose::kYaws;
    const auto mask = masks_.of(pose);
    most = std::max(most, bytes());
    ASSERT_EQ(mask, masks_.of(pose)) << "the newest is kept";
  }
  EXPECT_LE(most, static_cast<std::int64_t>(ShadowMasks::kMost) * 8500);
  EXPECT_GT(most, 0);
}

/// Would catch a shadow that jumps while its visitor turns or walks.
TEST_F(ShadowMasksTest, StepsAreTooSmallToSee) {
  const auto opacity = [&](const ShadowPose& pose, world::Vec2 place) { return opacityAt(*masks_.of(pose), place); };
  const ShadowPose pose{.yaw = 20, .phase = 0, .pace = ShadowPose::kPaces};
  ShadowPose turned = pose;
  ++turned.yaw;
  ShadowPose stepped = pose;
  ++stepped.phase;
  float sum = 0.0F;
  float byTurning = 0.0F;
  float byStepping = 0.0F;
  for (int row = 0; row < 100; ++row) {
    for (int column = -35; column < 35; ++column) {
      const world::Vec2 place(0.02F * static_cast<float>(column), 0.02F * static_cast<float>(row));
      const float before = opacity(pose, place);
      sum += before;
      byTurning += std::abs(opacity(turned, place) - before);
      byStepping += std::abs(opacity(stepped, place) - before);
    }
  }
  EXPECT_LT(byTurning, 0.05F * sum);
  EXPECT_LT(byStepping, 0.05F * sum);
  EXPECT_GT(byTurning, 0.0F);
  EXPECT_GT(byStepping, 0.0F);
}

/// Would catch shadows that are cut off by what a frame asks for.
TEST_F(ShadowMasksTest, LieWithinTheBoundsOfTheirObjects) {
  const world::Bounds body{Vec3(-0.5F, 0, -0.6F), Vec3(0.5F, 1.98F, 0.6F)};
  for (std::size_t stature = 0; stature < kStatures.size(); ++stature) {
    for (int yaw = 0; yaw < ShadowPose::kYaws; yaw += 16) {
      const auto mask = masks_.of({.stature = stature, .yaw = yaw, .phase = 12, .pace = ShadowPose::kPaces});
      const world::Transform transform{{3, 0, 4}, 6.2831853F * static_cast<float>(yaw) / ShadowPose::kYaws};
      const world::Bounds bounds = world::shadowBounds(transform.apply(body), sun_);
      const SunView& sun = masks_.sun();
      for (std::size_t i = 0; i < mask->opacity.size(); ++i) {
        if (mask->opacity[i] < 20) continue;
        const std::size_t column = i % kShadowColumns;
        const std::size_t row = i / kShadowColumns;
        const world::Vec2 texel(static_cast<float>(column) + 0.5F, static_cast<float>(row) + 0.5F);
        const world::Vec2 place = glm::mix(mask->low, mask->high, texel / world::Vec2(kShadowColumns, kShadowRows));
        const float away = (place.y - world::kShadowPlane) / sun.slope;
        const Vec3 point = transform.position + place.x * sun.side + away * sun.away;
        ASSERT_EQ(bounds.distance(point), 0.0F) << stature << ' ' << yaw << ' ' << place.x << ' ' << place.y;
      }
    }
  }
}

}  // namespace
}  // namespace grove::objects::figure
