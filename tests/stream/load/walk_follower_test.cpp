#include "stream/load/walk_follower.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace grove::stream {
namespace {

using world::Vec3;

constexpr double kInputSeconds = 0.016;

/// How far the real visitor strays from where the walk is, at most, and how long it took him to get to its beginning.
struct Course {
  float strays = 0.0F;
  double beganAt = 0.0;
  float turnedFromWalk = 0.0F;
};
Course follow(const WalkToFollow& plan, double offset, double seconds, int arriveBefore = 0) {
  world::Players players(plan.spawn, plan.spawnYaw, 32.0F, {});
  for (int i = 0; i < arriveBefore; ++i) players.join("before", 0.0);
  const world::PlayerId id = players.join("a", 0.0);
  WalkFollower follower(plan, world::placeOfArrival(id, plan.spawn, plan.spawnYaw), offset);
  Course course;
  bool began = false;
  std::uint32_t number = 0;
  for (double now = 0.0; now < seconds; now += kInputSeconds) {
    world::Input input = follower.steer(now);
    input.number = ++number;
    EXPECT_TRUE(players.apply(id, input, now));
    if (!follower.isOnWalk()) continue;
    if (!began) course.beganAt = now;
    began = true;
    const world::Pose real = players.find(id, now)->pose;
    const world::Pose wanted = plan.walk.thereAndBack(offset + now - course.beganAt);
    course.strays = std::max(course.strays, glm::length(real.position - wanted.position));
    course.turnedFromWalk =
        std::max(course.turnedFromWalk, std::abs(std::remainder(real.yaw - wanted.yaw, 6.2831853F)));
  }
  EXPECT_TRUE(began);
  return course;
}

TEST(WalkFollower, FollowsEveryTestWalk) {
  for (const char* name : {"clearing", "under_trees", "edge", "crowd"}) {
    const WalkToFollow plan{world::loadWalk(std::filesystem::path(GROVE_WALKS) / (std::string(name) + ".walk")),
                            Vec3(4.6F, 0.0F, 10.4F), 0.42F};
    const Course course = follow(plan, 0.0, 50.0);
    RecordProperty(name, std::to_string(course.strays));
    EXPECT_LT(course.strays, 0.25F) << name;
    EXPECT_LT(course.turnedFromWalk, 1e-3F) << name;
    EXPECT_LT(course.beganAt, 6.0) << name;
  }
}

/// Visitors arrive side by side; each has to find the same beginning.
TEST(WalkFollower, StartsFromAnyArrival) {
  const WalkToFollow plan{world::parseWalk("0 0 0 0 0\n4 4 0 1.57 0\n", "test"), Vec3(3, 0, 5), 1.0F};
  for (int before = 0; before < 9; ++before) EXPECT_LT(follow(plan, 0.0, 12.0, before).strays, 0.25F) << before;
}

TEST(WalkFollower, StartsWithinTheWalk) {
  const WalkToFollow plan{world::parseWalk("0 0 0 0 0\n10 10 0 1.57 0\n", "test"), Vec3(3, 0, 5), 0.0F};
  EXPECT_LT(follow(plan, 7.0, 30.0).strays, 0.25F);
}

}  // namespace
}  // namespace grove::stream
