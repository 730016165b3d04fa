#include "node/world/shared_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace grove::node {
namespace {

using ::testing::HasSubstr;
using testing::Server;
using testing::StrangeServer;

class SharedWorld : public ::testing::TestWithParam<TransportKind> {
 protected:
  testing::Workers workers_;
  WorldOwner owner_{testing::meadow().hash, testing::meadow().radius};
};

TEST_P(SharedWorld, VisitorsOfTwoServersSeeEachOther) {
  Server a(workers_, owner_, GetParam(), 1);
  Server b(workers_, owner_, GetParam(), 2);
  const world::PlayerId ann = a.players().join("Ann", pipeline::wallSeconds());
  const world::PlayerId bob = b.players().join("Bob", pipeline::wallSeconds());
  EXPECT_TRUE(a.reportsUntil([&] { return b.find(ann).has_value(); }));
  EXPECT_TRUE(b.reportsUntil([&] { return a.find(bob).has_value(); }));
  EXPECT_EQ(b.find(ann)->name, "Ann");
  EXPECT_EQ(owner_.visitors(), 2U);
  a.players().leave(ann);
  EXPECT_TRUE(a.reportsUntil([&] { return !b.find(ann); }));
  EXPECT_TRUE(a.find(bob)) << "he is still here";
}

/// Would catch one whose process stops reporting but stays on everybody's screen.
TEST_P(SharedWorld, VisitorsLeaveWithTheirServer) {
  Server b(workers_, owner_, GetParam(), 2);
  {
    Server a(workers_, owner_, GetParam(), 1);
    const world::PlayerId ann = a.players().join("Ann", pipeline::wallSeconds());
    ASSERT_TRUE(a.reportsUntil([&] { return b.find(ann).has_value(); }));
  }
  EXPECT_TRUE(tests::eventually([&] { return b.players().count() == 0; }));
  EXPECT_EQ(owner_.processes(), 1U);
}

/// Between two updates others walk on, and each update finds them where they are: no stutter.
TEST_P(SharedWorld, OwnServerDecidesPositions) {
  Server a(workers_, owner_, GetParam(), 1);
  Server b(workers_, owner_, GetParam(), 2);
  const world::PlayerId ann = a.players().join("Ann", pipeline::wallSeconds());
  ASSERT_TRUE(a.reportsUntil([&] { return b.find(ann).has_value(); }));
  ASSERT_TRUE(a.players().apply(ann, {1, world::kForward, 0.0F, 0.0F}, pipeline::wallSeconds()));
  ASSERT_TRUE(a.reportsUntil([&] { return b.find(ann)->velocity.z < -0.9F * world::kWalkSpeed; }));
  const double now = pipeline::wallSeconds();
  const float there = a.players().find(ann, now)->pose.position.z;
  const float here = b.players().find(ann, now)->pose.position.z;
  EXPECT_NEAR(here, there, 0.25F * world::kWalkSpeed) << "a quarter of a second of walking";
}

TEST_P(SharedWorld, ShortGustReachesTheOtherServer) {
  Server a(workers_, owner_, GetParam(), 1);
  Server b(workers_, owner_, GetParam(), 2);
  const world::PlayerId ann = a.players().join("Ann", pipeline::wallSeconds());
  ASSERT_TRUE(a.reportsUntil([&] { return b.find(ann).has_value(); }));
  world::Edits::Cursor cursor = 0;
  const auto felt = [&] { return b.edits().during(cursor, b.players().all(pipeline::wallSeconds())); };
  a.edits().startBlowing(*a.find(ann));
  a.edits().stopBlowing(ann);
  a.report();
  std::vector<world::Gust> gusts;
  EXPECT_TRUE(a.reportsUntil([&] { return !(gusts = felt()).empty(); }));
  ASSERT_EQ(gusts.size(), 1U);
  EXPECT_EQ(gusts[0].visitor, ann);
  EXPECT_TRUE(a.reportsUntil([&] { return felt().empty(); })) << "it ends";
}

TEST_P(SharedWorld, OwnerSetsTheClock) {
  Server a(workers_, owner_, GetParam(), 1);
  ASSERT_TRUE(tests::eventually([&] { return a.updates() > 3; }));
  const double now = pipeline::wallSeconds();
  EXPECT_NEAR(a.joined().worldSeconds(now), now, 0.5) << "they run on one machine here";
}

TEST_P(SharedWorld, LostOwnerFreezesThenRemovesRemoteVisitors) {
  using State = JoinedWorld::State;
  Server a(workers_, owner_, GetParam(), 1);
  world::PlayerId bob = 0;
  double lost = 0.0;
  {
    Server b(workers_, owner_, GetParam(), 2);
    bob = b.players().join("Bob", pipeline::wallSeconds());
    ASSERT_TRUE(b.players().apply(bob, {1, world::kForward, 0.0F, 0.0F}, pipeline::wallSeconds()));
    ASSERT_TRUE(b.reportsUntil([&] { return a.find(bob).has_value(); }));
    EXPECT_EQ(a.joined().status(pipeline::wallSeconds()).state, State::kJoined);
    a.hangUp();
    workers_.pool.drain();
    lost = pipeline::wallSeconds();
  }
  const world::PlayerId ann = a.players().join("Ann", lost);
  EXPECT_EQ(a.joined().status(lost + 1.5).state, State::kLost);
  a.joined().report(lost + 1.5);
  ASSERT_TRUE(a.players().find(bob, lost + 1.5));
  EXPECT_EQ(a.players().find(bob, lost + 1.5)->keys, 0) << "nobody walks on for ever";
  a.joined().report(lost + 11.0);
  EXPECT_FALSE(a.players().find(bob, lost + 11.0));
  EXPECT_TRUE(a.players().find(ann, lost + 11.0)) << "its own visitors stay";
}

TEST_P(SharedWorld, RefusesOtherScenesProtocolsAndTakenNumbers) {
  Server a(workers_, owner_, GetParam(), 1);
  ASSERT_TRUE(tests::eventually([&] { return owner_.processes() == 1; }));
  StrangeServer b(workers_, owner_, GetParam());
  EXPECT_THAT(b.hello({.build = "any", .sceneHash = 78, .process = 2, .types = {}}), HasSubstr("scenes differ"));
  EXPECT_THAT(b.hello({.protocol = 9, .build = "any", .sceneHash = 77, .process = 2, .types = {}}), HasSubstr("has 9"));
  EXPECT_THAT(b.hello({.build = "any", .sceneHash = 77, .process = 1, .types = {}}), HasSubstr("number 1"));
  EXPECT_EQ(owner_.processes(), 1U);
  EXPECT_EQ(b.updates(), 0) << "who is not welcome learns nothing of the world";
  EXPECT_EQ(b.hello({.build = "any", .sceneHash = 77, .process = 2, .types = {}}), "welcome");
}

TEST_P(SharedWorld, ServersReportOnlyTheirVisitorsAfterWelcome) {
  Server a(workers_, owner_, GetParam(), 1);
  const world::PlayerId ann = a.players().join("Ann", pipeline::wallSeconds());
  ASSERT_TRUE(a.reportsUntil([&] { return owner_.visitors() == 1; }));
  StrangeServer b(workers_, owner_, GetParam());
  const auto reportOf = [](world::PlayerId id, world::PlayerId blows) {
    auto report = std::make_shared<WorldUpdate>();
    report->number = 1;
    report->players.emplace_back().id = id;
    if (blows != 0) report->gusts.emplace_back().visitor = blows;
    return std::shared_ptr<const WorldUpdate>(std::move(report));
  };
  b.send(reportOf(makeId(2, 1), 0));
  EXPECT_EQ(owner_.visitors(), 1U) << "it is not welcome yet";
  ASSERT_EQ(b.hello({.build = "any", .sceneHash = 77, .process = 2, .types = {}}), "welcome");
  b.send(reportOf(makeId(1, 9), 0));
  b.send(reportOf(makeId(2, 1), ann));
  b.send(Quality{2});
  EXPECT_EQ(owner_.visitors(), 1U);
  b.send(reportOf(makeId(2, 1), makeId(2, 1)));
  EXPECT_EQ(owner_.visitors(), 2U);
  EXPECT_TRUE(a.find(ann)) << "nobody else's visitor is moved";
}

INSTANTIATE_TEST_SUITE_P(Over, SharedWorld, ::testing::Values(TransportKind::kReference, TransportKind::kBytes),
                         [](const auto& tested) {
                           return tested.param == TransportKind::kReference ? "Reference" : "Bytes";
                         });

}  // namespace
}  // namespace grove::node
