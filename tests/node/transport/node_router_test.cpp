#include "node/transport/node_router.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "node/messages/examples.h"
#include "node/transport/reference_transport.h"

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

TEST_F(Router, WhatIsAboutAnObjectGoesToWhoServesIt) {
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
TEST_F(Router, WhatANodeSaysOfAnotherOnesObjectIsDropped) {
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

TEST_F(Router, EverythingElseGoesToAll) {
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

TEST_F(Router, AnObjectOfTwoStaysWithTheFirstAndIsNamed) {
  a.welcome({1});
  b.welcome({1, 2});
  EXPECT_THAT(router.conflict().value_or(""), HasSubstr("is served by a and by b"));
  (void)ask(1);
  EXPECT_EQ(a.messages.size(), 1U);
}

}  // namespace
}  // namespace grove::node
