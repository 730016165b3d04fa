#include "world/players.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace grove::world {
namespace {

Players inTheOpen() { return {Vec3(0, 0, 0), 0.0F, 30.0F, {}}; }

TEST(Players, IdsStartAtTheBase) {
  constexpr PlayerId kBase = PlayerId{7} << 32U;
  Players players(Vec3(0, 0, 0), 0.0F, 12.0F, {}, {}, kBase);
  const PlayerId first = players.join("first", 0.0);
  EXPECT_EQ(first, kBase + 1);
  Players alone(Vec3(0, 0, 0), 0.0F, 12.0F, {});
  const PlayerId same = alone.join("first", 0.0);
  EXPECT_EQ(players.find(first, 0.0)->colour, alone.find(same, 0.0)->colour) << "a process does not change colours";
}

TEST(Players, WalkWhereTheyLook) {
  Players players = inTheOpen();
  const PlayerId id = players.join("a", 100.0);
  ASSERT_TRUE(players.apply(id, {1, kForward, glm::half_pi<float>(), 0.0F}, 100.0));
  const Player later = *players.find(id, 100.9);
  EXPECT_NEAR(later.pose.position.x, -kWalkSpeed * 0.9F, 0.3F);
  EXPECT_NEAR(later.pose.position.z, 0.0F, 1e-3F);
  EXPECT_GT(later.stride, 1.0F);
}

TEST(Players, DoNotDependOnTheObserver) {
  Players often = inTheOpen();
  Players seldom = inTheOpen();
  const PlayerId a = often.join("a", 0.0);
  const PlayerId b = seldom.join("a", 0.0);
  ASSERT_TRUE(often.apply(a, {1, kForward | kRun, 0.4F, 0.0F}, 0.0));
  ASSERT_TRUE(seldom.apply(b, {1, kForward | kRun, 0.4F, 0.0F}, 0.0));
  for (int i = 1; i < 600; ++i) (void)often.all(i * 0.0015);
  const Vec3 p = often.find(a, 0.9)->pose.position;
  const Vec3 q = seldom.find(b, 0.9)->pose.position;
  EXPECT_NEAR(glm::distance(p, q), 0.0F, 0.05F);
}

TEST(Players, StayOutsideOfStonesAndWithinTheWorld) {
  Players players(Vec3(0, 0, 0), 0.0F, 12.0F, {{{0.1F, -5.0F}, 1.0F}});
  const PlayerId id = players.join("a", 0.0);
  ASSERT_TRUE(players.apply(id, {1, kForward | kRun, 0.0F, 0.0F}, 0.0));
  for (int i = 1; i <= 200; ++i) {
    const Vec3 p = players.find(id, i * 0.05)->pose.position;
    EXPECT_GE(std::hypot(p.x - 0.1F, p.z + 5.0F), 1.3F);
    EXPECT_LE(std::hypot(p.x, p.z), 12.001F);
  }
}

// Fault: visitors walk through a hill, or above the ground behind it.
TEST(Players, WalkOverHills) {
  const std::vector<Hill> hills{{{0.0F, -10.0F}, 8.0F, 1.4F}};
  Players players(Vec3(0, 0, -3.0F), 0.0F, 30.0F, {}, hills);
  const PlayerId id = players.join("a", 0.0);
  EXPECT_GT(players.find(id, 0.0)->pose.position.y, kEyeHeight + 0.05F) << "arrives on its foot";
  ASSERT_TRUE(players.apply(id, {1, kForward | kRun, 0.0F, 0.0F}, 0.0));
  float highest = 0.0F;
  for (int i = 1; i <= 100; ++i) {
    const Vec3 eye = players.find(id, i * 0.05)->pose.position;
    ASSERT_FLOAT_EQ(eye.y, kEyeHeight + groundHeight(hills, {eye.x, eye.z}));
    highest = std::max(highest, eye.y);
  }
  EXPECT_NEAR(highest, kEyeHeight + 1.4F, 0.02F);
  EXPECT_FLOAT_EQ(players.find(id, 5.0)->pose.position.y, kEyeHeight);
}

// Fault: visitors arrive inside a hill and jump out of it at their first step.
TEST(Players, ArriveOnHills) {
  const std::vector<Hill> hills{{{2.0F, 9.0F}, 6.0F, 1.5F}};
  Players players(Vec3(2.0F, groundHeight(hills, {2.0F, 9.0F}), 9.0F), 0.7F, 30.0F, {}, hills);
  for (int i = 0; i < 5; ++i) {
    const Vec3 eye = players.find(players.join("a", 0.0), 0.0)->pose.position;
    EXPECT_NEAR(eye.y, kEyeHeight + groundHeight(hills, {eye.x, eye.z}), 1e-5F) << i;
    EXPECT_GT(eye.y, kEyeHeight + 0.5F);
  }
}

// Fault: visitors run into an invisible wall and stand still there.
TEST(Players, AreTurnedAlongTheEndOfTheWorld) {
  Players players(Vec3(0, 0, 0), 0.0F, 12.0F, {});
  const PlayerId id = players.join("a", 0.0);
  ASSERT_TRUE(players.apply(id, {1, kForward | kRun, 0.3F, 0.0F}, 0.0));
  const auto at = [&](double seconds) { return players.find(id, seconds)->pose.position; };
  float outward = 5.0F;
  for (int i = 1; i <= 80; ++i) {
    const Vec3 before = at((i - 1) * 0.1);
    const Vec3 now = at(i * 0.1);
    const float speed = 10.0F * (std::hypot(now.x, now.z) - std::hypot(before.x, before.z));
    if (i > 10) {
      EXPECT_GE(outward - speed, -0.05F) << "slows down, no faster again";
      EXPECT_LE(outward - speed, 1.5F) << "not at once";
    }
    outward = speed;
  }
  EXPECT_LT(outward, 0.1F);
  ASSERT_TRUE(players.apply(id, {2, kForward | kRun, 1.3F, 0.0F}, 8.0));
  const Vec3 before = at(8.2);
  EXPECT_GT(glm::distance(at(9.0), before), 3.0F) << "runs along the end";
}

TEST(Players, RefuseNonFiniteDirections) {
  Players players = inTheOpen();
  const PlayerId id = players.join("a", 0.0);
  EXPECT_FALSE(players.apply(id, {1, 0, std::numeric_limits<float>::quiet_NaN(), 0.0F}, 0.0));
  EXPECT_FALSE(players.apply(id, {1, 0, 0.0F, std::numeric_limits<float>::infinity()}, 0.0));
  EXPECT_EQ(players.find(id, 0.0)->lastInput, 0u);
}

TEST(Players, OldInputsAreIgnoredAndPitchIsBounded) {
  Players players = inTheOpen();
  const PlayerId id = players.join("a", 0.0);
  ASSERT_TRUE(players.apply(id, {5, 0, 1.0F, 40.0F}, 0.0));
  ASSERT_TRUE(players.apply(id, {4, kForward, 2.0F, 0.0F}, 0.0));
  const Player player = *players.find(id, 0.5);
  EXPECT_EQ(player.lastInput, 5u);
  EXPECT_FLOAT_EQ(player.pose.yaw, 1.0F);
  EXPECT_FLOAT_EQ(player.pose.pitch, kMaxPitch);
  EXPECT_NEAR(glm::length(player.velocity), 0.0F, 1e-6F);
}

TEST(Players, ArriveApartAndLeave) {
  Players players = inTheOpen();
  const PlayerId a = players.join("a", 0.0);
  const PlayerId b = players.join("b", 0.0);
  EXPECT_GT(glm::distance(players.find(a, 0)->pose.position, players.find(b, 0)->pose.position), 0.7F);
  EXPECT_NE(players.find(a, 0)->colour, players.find(b, 0)->colour);
  EXPECT_EQ(players.changes(), 2u);
  players.leave(a);
  EXPECT_EQ(players.count(), 1u);
  EXPECT_FALSE(players.find(a, 0).has_value());
  EXPECT_EQ(players.changes(), 3u);
  players.leave(a);
  EXPECT_EQ(players.changes(), 3u) << "he had gone";
}

TEST(Players, ShowRemotePlayersAsReported) {
  constexpr PlayerId kOther = PlayerId{7} << 32U;
  const auto isOther = [](PlayerId id) { return id > kOther; };
  Players players = inTheOpen();
  const PlayerId own = players.join("own", 0.0);
  Player other;
  other.id = kOther + 1;
  other.keys = kForward;
  players.mirror(std::vector<Player>{other}, isOther, 1.0);
  EXPECT_EQ(players.count(), 2u);
  EXPECT_EQ(players.changes(), 2u);
  EXPECT_LT(players.find(other.id, 1.5)->pose.position.z, -0.5F) << "he walks on until the next report";
  players.mirror(std::vector<Player>{other}, isOther, 1.5);
  EXPECT_EQ(players.find(other.id, 1.5)->pose.position.z, 0.0F) << "which counts";
  EXPECT_EQ(players.changes(), 2u) << "nobody came or went";
  players.mirror({}, isOther, 2.0);
  EXPECT_FALSE(players.find(other.id, 2.0));
  EXPECT_TRUE(players.find(own, 2.0));
  EXPECT_EQ(players.changes(), 3u);
}

}  // namespace
}  // namespace grove::world
