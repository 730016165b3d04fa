#include "objects/herd/backend/motion/performer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <vector>

#include "objects/herd/backend/mind/dice.h"
#include "objects/herd/backend/motion/motion_search.h"
#include "objects/herd/common/deer_skeleton.h"
#include "world/ground/hills.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

constexpr float kSize = 0.9F;

class PerformerTest : public ::testing::Test {
 protected:
  /// Advances one frame towards the goal.
  void step(Performer& performer, const MotionGoal& goal, bool again = false) {
    MotionGoal scaled = goal;
    if (scaled.place) scaled.place = *scaled.place / kSize;
    if (performer.needsNext() || (again && performer.isFree())) {
      performer.choose(search_.next(performer.frame(), performer.root(), scaled, [](Vec2) { return 0.0F; }));
    }
    performer.step(ground_);
  }
  [[nodiscard]] static Vec2 placeOf(const Performer& performer) {
    return {performer.pose().place.x, performer.pose().place.z};
  }

  const MotionDatabase database_{1};
  const MotionGraph graph_{database_};
  MotionSearch search_{graph_};
  const std::vector<world::Hill> hills_{{{0.0F, -6.0F}, 8.0F, 1.2F}, {{9.0F, 4.0F}, 6.0F, 0.8F}};
  const Ground ground_ = [this](Vec2 place) { return world::groundHeight(hills_, place); };
};

/// How far standing feet have moved from where they came down.
class Slides {
 public:
  void see(const Performer& performer) {
    const std::array<LegChain, kLegs> legs = legsOf(performer.pose(), kSize);
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      const bool stands = (performer.contacts() >> leg & 1U) != 0;
      if (stands && !stood_[leg]) first_[leg] = legs[leg].back();
      if (stands) worst_ = std::max(worst_, glm::distance(first_[leg], legs[leg].back()));
      stood_[leg] = stands;
    }
  }
  [[nodiscard]] float worst() const { return worst_; }

 private:
  std::array<bool, kLegs> stood_{};
  std::array<Vec3, kLegs> first_{};
  float worst_ = 0.0F;
};

// Faults: feet that slide while clips blend, on hills, or where legs do not reach; a trunk, a head or a foot that jumps
// where one clip follows another.
TEST_F(PerformerTest, GoesWithoutSlidesAndJumps) {
  Dice dice(5);
  Performer performer(graph_, graph_.someFrame(Activity::kGraze), {}, kSize, ground_);
  Slides slides;
  MotionGoal goal;
  AnimalPose last = performer.pose();
  Vec3 lastStep(0.0F);
  for (int tick = 0; tick < 5400; ++tick) {
    if (tick % 100 == 0) {
      const Vec2 place(dice.between(-14.0F, 14.0F), dice.between(-14.0F, 14.0F));
      const auto activity = static_cast<Activity>(dice.index(kActivities));
      goal = {activity, activity >= Activity::kWalk ? std::optional(place) : std::nullopt, {}};
    }
    step(performer, goal, tick % 10 == 0);
    slides.see(performer);
    const AnimalPose& pose = performer.pose();
    const Vec3 moved = pose.place - last.place;
    // Of a gallop's start and of its ends: two g.
    ASSERT_LT(glm::distance(moved, lastStep) * 30.0F * 30.0F, 20.0F) << "tick " << tick;
    ASSERT_LT(std::abs(std::remainder(pose.yaw - last.yaw, 6.2831853F)), 0.12F) << "tick " << tick;
    const auto now = std::bit_cast<std::array<float, kPostureValues>>(pose.posture);
    const auto before = std::bit_cast<std::array<float, kPostureValues>>(last.posture);
    // Ears and tails are quick.
    for (std::size_t i = 0; i < kPostureValues; ++i) {
      ASSERT_LT(std::abs(now[i] - before[i]), i < 8 ? 0.3F : 0.5F) << "tick " << tick << ", value " << i;
    }
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      ASSERT_LT(glm::distance(pose.feet[leg], last.feet[leg]), 0.6F) << "tick " << tick;
      ASSERT_GE(pose.feet[leg].y, ground_({pose.feet[leg].x, pose.feet[leg].z}) - 0.001F) << "under the ground";
    }
    lastStep = moved;
    last = pose;
  }
  EXPECT_LT(slides.worst(), 0.02F);
}

// Fault: an animal that does not get to where it wants, or does not stop there.
TEST_F(PerformerTest, ReachesPlaces) {
  for (const Vec2 place : {Vec2(0.0F, -9.0F), Vec2(8.0F, 3.0F), Vec2(-7.0F, 6.0F)}) {
    Performer performer(graph_, graph_.someFrame(Activity::kStand), {}, kSize, ground_);
    int ticks = 0;
    while (glm::distance(placeOf(performer), place) > 0.9F && ticks < 900) {
      step(performer, {Activity::kWalk, place, {}}, ticks % 12 == 0);
      ++ticks;
    }
    // At a metre per second, and some seconds to start and to turn.
    EXPECT_LT(ticks, static_cast<int>(30.0F * (glm::length(place) + 6.0F))) << place.x << ", " << place.y;
    for (int i = 0; i < 150; ++i) step(performer, {Activity::kGraze, {}, {}}, i % 12 == 0);
    EXPECT_EQ(performer.activity(), Activity::kGraze) << place.x << ", " << place.y;
    EXPECT_LT(glm::distance(placeOf(performer), place), 2.5F);
  }
}

// Fault: one that looks elsewhere.
TEST_F(PerformerTest, TurnsInPlace) {
  for (const float yaw : {1.6F, -2.4F}) {
    Performer performer(graph_, graph_.someFrame(Activity::kAlert), {}, kSize, ground_);
    for (int i = 0; i < 240; ++i) step(performer, {Activity::kAlert, {}, yaw}, i % 12 == 0);
    EXPECT_LT(std::abs(std::remainder(performer.root().yaw - yaw, 6.2831853F)), 0.5F) << yaw;
    EXPECT_LT(glm::length(placeOf(performer)), 2.0F);
  }
}

// Fault: flight at a walk.
TEST_F(PerformerTest, FleesAtAGallop) {
  Performer performer(graph_, graph_.someFrame(Activity::kGraze), {}, kSize, ground_);
  for (int i = 0; i < 150; ++i) step(performer, {Activity::kGallop, Vec2(0.0F, -60.0F), {}}, i % 12 == 0);
  EXPECT_EQ(performer.activity(), Activity::kGallop);
  EXPECT_GT(glm::length(placeOf(performer)), 9.0F) << "in five seconds";
}

// Fault: lookups that no animal shares.
TEST_F(PerformerTest, KeepsWhatOthersHaveLookedUp) {
  const auto walk = [&] {
    Performer performer(graph_, graph_.someFrame(Activity::kStand), {}, kSize, ground_);
    for (int i = 0; i < 200; ++i) step(performer, {Activity::kWalk, Vec2(0.0F, -9.0F), {}});
  };
  walk();
  const MotionSearch::Lookups before = search_.lookups();
  walk();
  const MotionSearch::Lookups after = search_.lookups();
  EXPECT_GT(after.all, before.all);
  EXPECT_EQ(after.all - after.cached, before.all - before.cached) << "the same way needs nothing new";
}

}  // namespace
}  // namespace grove::objects::herd
