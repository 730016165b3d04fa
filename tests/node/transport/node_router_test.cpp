#include "node/transport/node_router.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "node/messages/examples.h"
#include "node/transport/connection.h"
#include "node/transport/reference_transport.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

using pipeline::PushResult;
using ::testing::HasSubstr;

/// A node behind a link by reference, which keeps what it hears.
class Heard final : public BackendPort {
 public:
  Heard() { link->connect(*this); }
  ~Heard() override { link->leaveBackend(); }
  Heard(const Heard&) = delete;
  Heard& operator=(const Heard&) = delete;
  PushResult receive(ToBackend message) override {
    if (answer == PushResult::kAccepted) messages.push_back(std::move(message));
    return answer;
  }
  void welcome(const std::vector<world::ObjectId>& objects, bool visitors = false) {
    NodeWelcome welcome;
    welcome.epoch = 7;
    for (const world::ObjectId id : objects) welcome.objects.emplace_back().id = id;
    if (visitors) welcome.visitors.emplace();
    link->send(ToFrontend(welcome));
  }

  const std::shared_ptr<ReferenceTransport> link = std::make_shared<ReferenceTransport>();
  PushResult answer = PushResult::kAccepted;
  std::vector<ToBackend> messages;
};

class Router : public ::testing::Test {
 protected:
  Router() {
    router.add("a", a.link);
    router.add("b", b.link);
  }
  PushResult ask(world::ObjectId object) {
    Request request = examples::request();
    request.object = object;
    return router.send(std::move(request));
  }

  Heard a;
  Heard b;
  NodeRouter router;
};

TEST_F(Router, RoutesByObject) {
  a.welcome({1, 2});
  b.welcome({3}, true);
  EXPECT_EQ(ask(3), PushResult::kAccepted);
  EXPECT_EQ(ask(world::kFirstPlayerObject + 7), PushResult::kAccepted);
  EXPECT_EQ(ask(2), PushResult::kAccepted);
  EXPECT_EQ(ask(4), PushResult::kClosed) << "of nobody";
  EXPECT_EQ(router.send(Acknowledgement{.what = {.object = 3, .key = {}}, .version = 1}), PushResult::kAccepted);
  EXPECT_EQ(router.send(Unsubscribe{.what = {.object = 3, .key = {}}}), PushResult::kAccepted);
  EXPECT_EQ(a.messages.size(), 1U);
  EXPECT_EQ(b.messages.size(), 4U);
  EXPECT_EQ(router.served().objects, (std::set<world::ObjectId>{1, 2, 3}));
  EXPECT_TRUE(router.served().visitors);
  b.answer = PushResult::kRejected;
  EXPECT_EQ(ask(3), PushResult::kRejected) << "what the node says counts";
}

/// Takes what comes through the router.
class HeardByFrontend final : public FrontendPort {
 public:
  void receive(ToFrontend message) override { messages.push_back(std::move(message)); }
  std::vector<ToFrontend> messages;
};

/// Would catch a node that shows its own pictures in place of another one's.
TEST_F(Router, DropsMessagesAboutForeignObjects) {
  HeardByFrontend screen;
  router.connect(screen);
  a.welcome({1, 2});
  b.welcome({3}, true);
  screen.messages.clear();
  const auto says = [&](Heard& node, world::ObjectId object) {
    node.link->send(ToFrontend(Announcement{.what = {.object = object, .key = {}}, .version = 1}));
    Result result;
    result.what.object = object;
    node.link->send(ToFrontend(std::move(result)));
    return std::exchange(screen.messages, {}).size();
  };
  EXPECT_EQ(says(a, 1), 2U);
  EXPECT_EQ(says(b, world::kFirstPlayerObject + 5), 2U);
  EXPECT_EQ(says(b, 1), 0U);
  EXPECT_EQ(says(a, world::kFirstPlayerObject + 5), 0U);
  EXPECT_EQ(says(a, 9), 0U) << "of nobody";
  router.leaveFrontend();
}

TEST_F(Router, ReportsItsLinks) {
  EXPECT_FALSE(router.links().at(0).epoch) << "before its welcome";
  a.welcome({1, 2});
  b.welcome({3}, true);
  const std::vector<NodeRouter::NodeLink> links = router.links();
  ASSERT_EQ(links.size(), 2U);
  EXPECT_EQ(links[0].name, "a");
  EXPECT_EQ(links[0].objects, 2U);
  EXPECT_EQ(links[1].objects, 1U) << "visitors are not counted";
  EXPECT_EQ(links[0].status.state, LinkState::kHere);
  EXPECT_EQ(links[0].epoch, 7U);
}

/// The link to a node in another process, which answers requests for traces.
class ReportingNode final : public FrontendEnd {
 public:
  void connect(FrontendPort& frontend) override { frontend_.connect(frontend); }
  void leaveFrontend() override { frontend_.leave(); }
  [[nodiscard]] LinkStatus status() const override { return {state, {}}; }
  [[nodiscard]] LinkPace pace() const override { return {.roundTrip = 0.5}; }
  PushResult send(ToBackend message) override {
    const auto* const request = std::get_if<TraceRequest>(&message);
    if (request == nullptr || !answers) return PushResult::kAccepted;
    NodeTrace trace = examples::trace();
    trace.number = request->number + wrongBy;
    says(std::make_shared<const NodeTrace>(trace));
    return PushResult::kAccepted;
  }
  void says(const ToFrontend& message) {
    frontend_.use([&](FrontendPort* port) {
      if (port != nullptr) port->receive(message);
    });
  }
  /// Its clock is a hundred seconds ahead, and what it reports travels for a quarter of a second.
  void report() {
    NodeReport report = examples::report();
    report.sent = pipeline::wallSeconds() + 100.0 - 0.25;
    says(report);
  }

  LinkState state = LinkState::kWelcomed;
  bool answers = true;
  std::uint32_t wrongBy = 0;

 private:
  Connection<FrontendPort> frontend_;
};

class ReportingRouter : public ::testing::Test {
 protected:
  ReportingRouter() { router.add("far", node); }
  std::optional<NodeReport> report() { return router.links().at(0).report; }
  std::size_t traces() { return router.traces(std::chrono::milliseconds(1)).size(); }

  const std::shared_ptr<ReportingNode> node = std::make_shared<ReportingNode>();
  NodeRouter router;
};

TEST_F(ReportingRouter, KeepsTheNewestReportOfEachNode) {
  EXPECT_FALSE(report());
  node->report();
  ASSERT_TRUE(report());
  EXPECT_EQ(report()->residentBytes, examples::report().residentBytes);
  node->state = LinkState::kLost;
  EXPECT_FALSE(report()) << "figures of the past";
  node->state = LinkState::kWelcomed;
  node->says(NodeWelcome{});
  EXPECT_FALSE(report()) << "of the process that it was";
}

TEST_F(ReportingRouter, TracesHaveTheirNodesClock) {
  EXPECT_EQ(traces(), 0U) << "of no known clock";
  node->report();
  const auto events = router.traces(std::chrono::seconds(10));
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].name, "far");
  EXPECT_EQ(events[0].trace->runs.size(), 2U);
  EXPECT_NEAR(static_cast<double>(events[0].aheadNanoseconds), 100.0e9, 0.2e9);
}

/// Would catch a report that hangs with a node, and a node that answers what nobody has requested.
TEST_F(ReportingRouter, MissingTracesAreSkipped) {
  node->report();
  node->wrongBy = 1;
  EXPECT_EQ(traces(), 0U);
  node->wrongBy = 0;
  node->answers = false;
  EXPECT_EQ(traces(), 0U) << "not the last one again";
  node->answers = true;
  node->state = LinkState::kHere;
  EXPECT_EQ(traces(), 0U) << "what this process does stands in its own trace";
  node->state = LinkState::kWelcomed;
  EXPECT_EQ(traces(), 1U);
}

TEST_F(Router, BroadcastsTheRest) {
  b.answer = PushResult::kClosed;
  EXPECT_EQ(router.send(examples::hello()), PushResult::kAccepted) << "one that is away holds up nobody";
  b.answer = PushResult::kAccepted;
  EXPECT_EQ(router.send(Forget{1}), PushResult::kAccepted);
  EXPECT_EQ(a.messages.size(), 2U);
  EXPECT_EQ(b.messages.size(), 1U);
  a.answer = b.answer = PushResult::kClosed;
  EXPECT_EQ(router.send(Quality{1}), PushResult::kClosed);
}

TEST_F(Router, TheLastWelcomeCounts) {
  a.welcome({1, 2});
  a.welcome({2});
  EXPECT_EQ(ask(1), PushResult::kClosed);
  b.welcome({1});
  EXPECT_EQ(ask(1), PushResult::kAccepted);
  EXPECT_EQ(b.messages.size(), 1U);
  EXPECT_FALSE(router.conflict());
}

TEST_F(Router, DuplicateObjectStaysWithTheFirst) {
  a.welcome({1});
  b.welcome({1, 2});
  EXPECT_THAT(router.conflict().value_or(""), HasSubstr("is served by a and by b"));
  (void)ask(1);
  EXPECT_EQ(a.messages.size(), 1U);
}

}  // namespace
}  // namespace grove::node
