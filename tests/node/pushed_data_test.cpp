#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "eventually.h"
#include "node/limits.h"
#include "node/nodes_fixture.h"
#include "node/one_node.h"

namespace grove::node {
namespace {

using testing::Screen;
using tests::eventually;

/// The same boxes, with colours that a clock changes.
class PushedData : public testing::Nodes {
 protected:
  PushedData() : Nodes(testing::BoxAsks::kClocked) { controls->cadence = 30.0; }

  /// Uses both boxes; whether the process has this version of them.
  bool shows(Version version) {
    return std::ranges::all_of(scene.layout.objects, [&](const world::Object& object) {
      const auto data = process.shared().find({object.id, {}});
      return data && data->version() == version;
    });
  }
  void tick() {
    ++controls->version;
    for (const world::Object& object : scene.layout.objects) controls->announce({{object.id, {}}, controls->version});
  }
  /// Until the node pushes.
  void subscribe() {
    const auto screen = std::make_shared<Screen>(workers, timeline);
    const auto node = frontend(1, 0.0F, screen);
    ASSERT_TRUE(node->requestFrame());
    ASSERT_TRUE(screen->waitFor(1));
    ASSERT_TRUE(shows(1));
    tick();
    ASSERT_TRUE(eventually([&] { return shows(2); }));
    ASSERT_EQ(transport.requests, 4) << "two for each box";
  }
};

TEST_P(PushedData, NeedsNoFurtherRequests) {
  ASSERT_NO_FATAL_FAILURE(subscribe());
  for (Version version = 3; version < 30; ++version) {
    tick();
    ASSERT_TRUE(eventually([&, version] { return shows(version); })) << version;
    EXPECT_EQ(controls->known, transport.sharesMemory() ? 0U : version - 1) << "what the process has";
  }
  EXPECT_EQ(transport.requests, 4);
  EXPECT_EQ(timeline.counters()["unrequested shared data"], 0);
}

/// Would catch versions that queue on a slow link, and a last one that never comes.
TEST_P(PushedData, SlowLinksSkipVersions) {
  ASSERT_NO_FATAL_FAILURE(subscribe());
  transport.keepBack = true;
  for (int i = 0; i < 50; ++i) {
    tick();
    workers.drain();
  }
  EXPECT_EQ(transport.kept(), 2 * kMaxUnacknowledged);
  transport.release();
  EXPECT_TRUE(eventually([&] { return shows(52); }));
  EXPECT_EQ(transport.requests, 4);
  tick();
  EXPECT_TRUE(eventually([&] { return shows(53); }));
}

/// Would catch a process that shows old data for ever, because all that follows changes what it has not got.
TEST_P(PushedData, ExceptionsCostNoLaterVersion) {
  using Fault = testing::FaultyTransport::Fault;
  ASSERT_NO_FATAL_FAILURE(subscribe());
  Version version = 2;
  for (const Fault fault : {Fault::kCompress, Fault::kSendResult, Fault::kDecompress}) {
    transport.next = fault;
    tick();
    workers.drain();
    version += 2;
    tick();
    EXPECT_TRUE(eventually([&] { return shows(version); })) << "fault " << static_cast<int>(fault);
    EXPECT_EQ(transport.next, Fault::kNone) << "it has happened";
    const int requests = transport.requests;
    tick();
    ++version;
    EXPECT_TRUE(eventually([&] { return shows(version); }));
    tick();
    ++version;
    EXPECT_TRUE(eventually([&] { return shows(version); }));
    EXPECT_LE(transport.requests, requests + 2) << "it is subscribed to again";
  }
}

INSTANTIATE_TEST_SUITE_P(OverEach, PushedData, testing::kAllTransports, testing::transportName);

/// A frontend process that subscribes with words of its own.
class SubscribingRawPeer : public ::testing::TestWithParam<TransportKind> {
 protected:
  SubscribingRawPeer() { node.controls->cadence = 30.0; }

  [[nodiscard]] Request subscription(world::ObjectId object) const {
    Request request;
    request.process = 2;
    request.object = object;
    request.shared = true;
    request.subscribe = true;
    return request;
  }
  void tick() {
    node.controls->announce({{box(), {}}, ++node.controls->version});
    rawPeer.settle();
  }
  [[nodiscard]] world::ObjectId box() const { return node.scene.objects[0].id; }

  OneNode node;
  RawPeer rawPeer{node, GetParam()};
};

TEST_P(SubscribingRawPeer, UnknownKeyFailsAndServiceContinues) {
  ASSERT_EQ(rawPeer.hello(2), "");
  (void)rawPeer.send(subscription(99));
  rawPeer.settle();
  const auto said = rawPeer.messages();
  if (GetParam() == TransportKind::kBytes) {
    ASSERT_EQ(said.size(), 1U);
    EXPECT_TRUE(std::holds_alternative<Failure>(std::get<Result>(said[0]).payload));
  }
  node.controls->fail = true;
  (void)rawPeer.send(subscription(box()));
  rawPeer.settle();
  node.controls->fail = false;
  EXPECT_TRUE(std::holds_alternative<Failure>(std::get<Result>(rawPeer.messages().at(0)).payload));
  tick();
  EXPECT_TRUE(std::holds_alternative<Announcement>(rawPeer.messages().at(0))) << "it has not subscribed";
  (void)rawPeer.send(subscription(box()));
  rawPeer.settle();
  EXPECT_FALSE(std::get<Result>(rawPeer.messages().at(0)).pushed);
  tick();
  EXPECT_TRUE(std::get<Result>(rawPeer.messages().at(0)).pushed);
}

TEST_P(SubscribingRawPeer, GetsNothingAfterItsEndOrANewHello) {
  for (const bool unsubscribes : {true, false}) {
    ASSERT_EQ(rawPeer.hello(2), "");
    (void)rawPeer.send(subscription(box()));
    rawPeer.settle();
    rawPeer.messages();
    if (unsubscribes) {
      (void)rawPeer.send(Unsubscribe{.what = {box(), {}}});
      rawPeer.settle();
    } else {
      ASSERT_EQ(rawPeer.hello(2), "");
    }
    tick();
    const auto said = rawPeer.messages();
    ASSERT_EQ(said.size(), 1U);
    EXPECT_TRUE(std::holds_alternative<Announcement>(said[0]));
  }
}

TEST_P(SubscribingRawPeer, UnclockedDataIsAnnounced) {
  node.controls->cadence = 0.0;
  ASSERT_EQ(rawPeer.hello(2), "");
  (void)rawPeer.send(subscription(box()));
  rawPeer.settle();
  rawPeer.messages();
  tick();
  EXPECT_TRUE(std::holds_alternative<Announcement>(rawPeer.messages().at(0)));
}

INSTANTIATE_TEST_SUITE_P(OverBoth, SubscribingRawPeer, testing::kBothInMemory, testing::transportName);

}  // namespace
}  // namespace grove::node
