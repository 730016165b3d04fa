#include "node/backend/world_mirror.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <vector>

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr ProcessId kOwner = 1;

world::Gust gustOf(world::PlayerId visitor, float speed) {
  world::Gust gust;
  gust.visitor = visitor;
  gust.speed = speed;
  return gust;
}

std::shared_ptr<const WorldUpdate> update(std::uint64_t number, std::initializer_list<world::PlayerId> players,
                                          std::vector<world::Gust> gusts = {}) {
  auto made = std::make_shared<WorldUpdate>();
  made->number = number;
  for (const world::PlayerId id : players) made->players.emplace_back().id = id;
  made->gusts = std::move(gusts);
  return made;
}

std::vector<world::PlayerId> ids(const WorldMirror& mirror) {
  std::vector<world::PlayerId> ids;
  for (const world::Player& player : mirror.players()) ids.push_back(player.id);
  return ids;
}

std::vector<float> speeds(const WorldMirror& mirror, WorldMirror::Cursor& cursor) {
  std::vector<float> speeds;
  for (const world::Gust& gust : mirror.gusts(cursor)) speeds.push_back(gust.speed);
  return speeds;
}

TEST(WorldMirror, StartsEmpty) {
  const WorldMirror mirror;
  WorldMirror::Cursor cursor = 0;
  EXPECT_THAT(ids(mirror), IsEmpty());
  EXPECT_THAT(speeds(mirror, cursor), IsEmpty());
}

TEST(WorldMirror, FollowsTheOwnersClock) {
  WorldMirror mirror;
  EXPECT_FALSE(mirror.now());
  const auto timed = std::make_shared<WorldUpdate>();
  timed->number = 1;
  timed->clock = 7000.0;
  mirror.apply(kOwner, timed);
  ASSERT_TRUE(mirror.now());
  EXPECT_GE(*mirror.now(), 7000.0);
  EXPECT_LT(*mirror.now(), 7010.0);
}

TEST(PeerClock, UsesTheSampleWithTheSmallestRoundTrip) {
  PeerClock clock;
  EXPECT_FALSE(clock.at(1.0));
  clock.addReport(100.0, 1.3);  // took 0.3
  EXPECT_NEAR(*clock.at(2.0), 100.7, 1e-9);
  clock.addReport(101.0, 2.1);
  EXPECT_NEAR(*clock.at(3.0), 101.9, 1e-9);
  clock.addReport(102.0, 3.8);
  EXPECT_NEAR(*clock.at(4.0), 102.9, 1e-9) << "a slow one tells nothing new";
}

TEST(PeerClock, FollowsDriftAndRestart) {
  PeerClock clock;
  for (int i = 0; i < 2000; ++i) clock.addReport(0.9 * i, i);
  EXPECT_NEAR(*clock.at(2000.0), 0.9 * 2000.0, 15.0);
  for (int i = 2000; i < 2200; ++i) clock.addReport(i - 2000, i);
  EXPECT_NEAR(*clock.at(2200.0), 200.0, 1e-9);
}

/// Would catch one wrong report that lets every deadline pass.
TEST(PeerClock, OutliersNeedConfirmation) {
  PeerClock clock;
  clock.addReport(100.0, 0.0);
  for (const double wrong : {1.0e9, -1.0e9}) {
    clock.addReport(wrong, 1.0);
    EXPECT_NEAR(*clock.at(2.0), 102.0, 1e-9);
    clock.addReport(103.0, 3.0);
    EXPECT_NEAR(*clock.at(4.0), 104.0, 1e-9);
  }
  clock.addReport(500.0, 5.0);
  clock.addReport(501.0, 6.0);
  EXPECT_NEAR(*clock.at(7.0), 502.0, 1e-9) << "the peer began anew";
}

TEST(PeerClock, WrongFirstSampleIsForgotten) {
  PeerClock clock;
  clock.addReport(1.0e9, 0.0);
  clock.addReport(101.0, 1.0);
  clock.addReport(102.0, 2.0);
  EXPECT_NEAR(*clock.at(3.0), 103.0, 1e-9);
}

TEST(WorldMirror, NewestUpdateWinsInAnyOrder) {
  WorldMirror mirror;
  mirror.apply(kOwner, update(2, {7, 8}));
  mirror.apply(kOwner, update(1, {7}));
  EXPECT_THAT(ids(mirror), ElementsAre(7, 8));
  mirror.apply(kOwner, update(3, {}));
  EXPECT_THAT(ids(mirror), IsEmpty());
}

/// Or one number that is nonsense would keep all players where they were, for ever.
TEST(WorldMirror, SequenceNumbersWrapAround) {
  for (const std::uint64_t nonsense : {~std::uint64_t{0}, std::uint64_t{1} << 63U, std::uint64_t{1} << 32U}) {
    WorldMirror mirror;
    WorldMirror::Cursor cursor = 0;
    mirror.apply(kOwner, update(4, {7}));
    mirror.apply(kOwner, update(nonsense, {}));
    EXPECT_THAT(speeds(mirror, cursor), IsEmpty());
    mirror.apply(kOwner, update(5, {7, 8}, {gustOf(7, 2.0F)}));
    mirror.apply(kOwner, update(6, {7, 8}));
    EXPECT_THAT(ids(mirror), ElementsAre(7, 8));
    EXPECT_THAT(speeds(mirror, cursor), ElementsAre(2.0F)) << "which blew between two ticks";
  }
}

/// Two clocks and two lists of players would take turns in one simulation.
TEST(WorldMirror, BelongsToTheFirstReporter) {
  WorldMirror mirror;
  WorldMirror::Cursor cursor = 0;
  EXPECT_TRUE(mirror.apply(1, update(100, {7}, {gustOf(7, 1.0F)})));
  EXPECT_FALSE(mirror.apply(2, update(101, {8})));
  mirror.leave(2);
  EXPECT_THAT(ids(mirror), ElementsAre(7));
  EXPECT_THAT(speeds(mirror, cursor), ElementsAre(1.0F));
  mirror.leave(1);
  EXPECT_THAT(ids(mirror), IsEmpty());
  EXPECT_THAT(speeds(mirror, cursor), IsEmpty());
  EXPECT_FALSE(mirror.now());
  EXPECT_TRUE(mirror.apply(2, update(1, {8}, {gustOf(8, 2.0F)})));
  EXPECT_TRUE(mirror.apply(2, update(2, {8})));
  EXPECT_THAT(ids(mirror), ElementsAre(8));
  EXPECT_THAT(speeds(mirror, cursor), ElementsAre(2.0F)) << "its count begins where it likes";
}

TEST(WorldMirror, HeldGustsBlowEveryTick) {
  WorldMirror mirror;
  WorldMirror::Cursor cursor = 0;
  mirror.apply(kOwner, update(1, {1}, {gustOf(1, 2.0F)}));
  for (int tick = 0; tick < 3; ++tick) EXPECT_THAT(speeds(mirror, cursor), ElementsAre(2.0F));
  mirror.apply(kOwner, update(2, {1}));
  EXPECT_THAT(speeds(mirror, cursor), IsEmpty());
}

TEST(WorldMirror, SlowSimulationGetsEachGustOnce) {
  WorldMirror mirror;
  WorldMirror::Cursor slow = 0;
  WorldMirror::Cursor other = 0;
  mirror.apply(kOwner, update(1, {1, 2}, {gustOf(1, 1.0F)}));
  EXPECT_THAT(speeds(mirror, other), ElementsAre(1.0F));
  mirror.apply(kOwner, update(2, {1, 2}, {gustOf(1, 3.0F), gustOf(2, 5.0F)}));
  mirror.apply(kOwner, update(3, {1, 2}));
  EXPECT_THAT(speeds(mirror, slow), UnorderedElementsAre(3.0F, 5.0F)) << "of each visitor the newest";
  EXPECT_THAT(speeds(mirror, slow), IsEmpty());
  EXPECT_THAT(speeds(mirror, other), UnorderedElementsAre(3.0F, 5.0F)) << "each reads for itself";
}

TEST(WorldMirror, KeepsALimitedPast) {
  WorldMirror mirror;
  mirror.apply(kOwner, update(1, {1}, {gustOf(1, 1.0F)}));
  for (std::uint64_t number = 2; number < 200; ++number) mirror.apply(kOwner, update(number, {1}, {gustOf(2, 2.0F)}));
  WorldMirror::Cursor cursor = 0;
  EXPECT_THAT(speeds(mirror, cursor), ElementsAre(2.0F));
}

TEST(WorldMirror, WakesOnlyWithVisitorsAndToken) {
  WorldMirror mirror;
  int woken = 0;
  auto token = mirror.whileVisited([&] { ++woken; });
  mirror.apply(kOwner, update(1, {}));
  EXPECT_EQ(woken, 0);
  mirror.apply(kOwner, update(2, {1}));
  mirror.apply(kOwner, update(3, {1}));
  EXPECT_EQ(woken, 2);
  mirror.apply(kOwner, update(3, {1}));
  EXPECT_EQ(woken, 2) << "nothing new";
  mirror.apply(kOwner, update(4, {}));
  EXPECT_EQ(woken, 2);
  token.reset();
  mirror.apply(kOwner, update(5, {1}));
  EXPECT_EQ(woken, 2);
}

}  // namespace
}  // namespace grove::node
