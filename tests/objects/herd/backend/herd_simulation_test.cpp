#include "objects/herd/backend/mind/herd_simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sanitized.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;

constexpr int kMinute = 30 * 60;
const Vec2 kFire(4.0F, 3.0F);
constexpr std::array<world::Obstacle, 2> kTrees{{{Vec2(-3.0F, 2.0F), 0.8F}, {Vec2(6.0F, -6.0F), 1.2F}}};

class HerdSimulationTest : public ::testing::Test {
 protected:
  [[nodiscard]] static Terrain terrain() {
    return {{0.0F, 0.0F}, 15.0F, {{{-6.0F, -4.0F}, 8.0F, 1.0F}}, {kTrees.begin(), kTrees.end()}, {kFire}};
  }
  [[nodiscard]] HerdSimulation herd(std::size_t animals = 8) const { return {graph_, terrain(), animals, 3}; }

  [[nodiscard]] static world::Player visitorAt(Vec2 place, float speed = 0.0F) {
    world::Player visitor;
    visitor.pose.position = {place.x, world::kEyeHeight, place.y};
    visitor.velocity = {speed, 0.0F, 0.0F};
    return visitor;
  }
  [[nodiscard]] static Vec2 placeOf(const Animal& animal) { return {animal.now.place.x, animal.now.place.z}; }

  const MotionDatabase database_{1};
  const MotionGraph graph_{database_};
};

// Faults: animals that walk through trees, fire and each other, or leave for ever.
TEST_F(HerdSimulationTest, KeepsClearOfObstaclesAndFire) {
  HerdSimulation herd = this->herd();
  float toFire = 10.0F;
  float toTrees = 10.0F;
  float toOthers = 10.0F;
  float farthest = 0.0F;
  for (int tick = 0; tick < (kSanitized ? 1 : 4) * kMinute; ++tick) {
    herd.step({});
    for (const Animal& animal : herd.animals()) {
      const Vec2 place = placeOf(animal);
      toFire = std::min(toFire, glm::distance(place, kFire));
      for (const world::Obstacle& tree : kTrees) {
        toTrees = std::min(toTrees, glm::distance(place, tree.centre) - tree.radius);
      }
      farthest = std::max(farthest, glm::length(place));
      for (const Animal& other : herd.animals()) {
        if (&other != &animal) toOthers = std::min(toOthers, glm::distance(place, placeOf(other)));
      }
    }
  }
  EXPECT_GT(toFire, 3.5F);
  EXPECT_GT(toTrees, 0.0F);
  EXPECT_GT(toOthers, 0.3F);
  EXPECT_LT(farthest, 18.0F);
}

// Fault: a herd that only stands.
TEST_F(HerdSimulationTest, GrazesAndWalksByTurns) {
  HerdSimulation herd = this->herd();
  std::array<int, kActivities> ticks{};
  for (int tick = 0; tick < kMinute; ++tick) {
    herd.step({});
    for (std::size_t i = 0; i < herd.animals().size(); ++i) {
      ++ticks[static_cast<std::size_t>(herd.performer(i).activity())];
    }
  }
  const int all = kMinute * 8;
  EXPECT_GT(ticks[static_cast<std::size_t>(Activity::kGraze)], all / 20);
  EXPECT_GT(ticks[static_cast<std::size_t>(Activity::kWalk)], all / 20);
  EXPECT_LT(ticks[static_cast<std::size_t>(Activity::kGallop)], all / 100) << "nobody chases them";
}

// Faults: tame animals; animals that run towards who frightens them.
TEST_F(HerdSimulationTest, FleesFromWhoWalksUp) {
  HerdSimulation herd = this->herd(3);
  for (int tick = 0; tick < 60; ++tick) herd.step({});
  Vec2 visitor = placeOf(herd.animals()[0]) + Vec2(13.0F, 0.0F);
  bool watched = false;
  bool fled = false;
  float closest = 100.0F;
  for (int tick = 0; tick < 20 * 30; ++tick) {
    const Vec2 way = placeOf(herd.animals()[0]) - visitor;
    if (glm::length(way) > 2.0F) visitor += glm::normalize(way) * (world::kWalkSpeed / 30.0F);
    const world::Player player = visitorAt(visitor, world::kWalkSpeed);
    herd.step({&player, 1});
    watched = watched || herd.mind(0).mood() == AnimalMind::Mood::kWatchful;
    if (herd.mind(0).mood() == AnimalMind::Mood::kFleeing && herd.performer(0).activity() == Activity::kGallop)
      fled = true;
    closest = std::min(closest, glm::distance(visitor, placeOf(herd.animals()[0])));
  }
  EXPECT_TRUE(watched);
  EXPECT_TRUE(fled);
  EXPECT_GT(closest, 1.5F);
}

// Fault: a herd that never gets used to a quiet visitor, of whom there is always one.
TEST_F(HerdSimulationTest, GrazesNearWhoStandsStill) {
  HerdSimulation herd = this->herd();
  const world::Player quiet = visitorAt({0.0F, 9.0F});
  std::array<int, 3> ticks{};
  for (int tick = 0; tick < 2 * kMinute; ++tick) {
    herd.step({&quiet, 1});
    if (tick < kMinute) continue;
    for (std::size_t i = 0; i < 8; ++i) ++ticks[static_cast<std::size_t>(herd.mind(i).mood())];
  }
  EXPECT_GT(ticks[static_cast<std::size_t>(AnimalMind::Mood::kCalm)], 6 * kMinute);
  EXPECT_LT(ticks[static_cast<std::size_t>(AnimalMind::Mood::kFleeing)], kMinute / 2);
}

// Fault: a herd of chance, which two nodes would not agree on.
TEST_F(HerdSimulationTest, IsTheSameForTheSameVisitors) {
  HerdSimulation one = herd();
  HerdSimulation other = herd();
  const world::Player visitor = visitorAt({5.0F, 8.0F}, 1.0F);
  for (int tick = 0; tick < 600; ++tick) {
    one.step({&visitor, 1});
    other.step({&visitor, 1});
  }
  for (std::size_t i = 0; i < one.animals().size(); ++i) {
    EXPECT_EQ(one.animals()[i].now.place, other.animals()[i].now.place);
    EXPECT_EQ(one.animals()[i].now.feet, other.animals()[i].now.feet);
  }
}

}  // namespace
}  // namespace grove::objects::herd
