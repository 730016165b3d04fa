#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "base/error.h"
#include "node/transport/grpc/link_limits.h"
#include "node/transport/grpc/links_fixture.h"
#include "node/transport/packets/packets.h"

namespace grove::node {
namespace {

using pipeline::PushResult;
using testing::FrontendSide;
using testing::NodeEnd;
using testing::NodeProcess;
using tests::eventually;
using State = GrpcFrontendEnd::State;

TEST(GrpcLinks, WelcomeInTurn) {
  NodeProcess node;
  FrontendSide a(node.address());
  FrontendSide b(node.address());
  EXPECT_TRUE(a.isWelcomed());
  EXPECT_TRUE(b.isWelcomed());
  EXPECT_EQ(a.count(), 1U) << "its port hears the welcome, too";
  EXPECT_EQ(a.send(Quality{1}), PushResult::kAccepted);
  EXPECT_TRUE(eventually([&] { return node.end(0)->count() == 2 || node.end(1)->count() == 2; }));
  EXPECT_EQ(node.end(0)->count() + node.end(1)->count(), 3U) << "each has a stream of its own";
}

TEST(GrpcLinks, RefuseToSendWithoutNode) {
  int port = 0;
  {
    const NodeProcess gone;
    port = gone.port();
  }
  FrontendSide side("127.0.0.1:" + std::to_string(port));
  EXPECT_EQ(side.send(examples::hello()), PushResult::kClosed);
  EXPECT_EQ(side.send(examples::request()), PushResult::kClosed);
  EXPECT_EQ(side.link().status().state, State::kConnecting);
  EXPECT_FALSE(side.link().waitUntilOpen(std::chrono::milliseconds(20)));
  NodeProcess node(port);
  EXPECT_TRUE(side.becomes(State::kWelcomed)) << "what was said before is said to the first who hears";
}

TEST(GrpcLinks, ReconnectedNodeGetsHelloWorldAndQualityFirst) {
  auto node = std::make_unique<NodeProcess>();
  const int port = node->port();
  FrontendSide side(node->address());
  ASSERT_TRUE(side.isWelcomed());
  for (std::uint64_t number = 1; number <= 3; ++number) {
    WorldUpdate update = examples::world();
    update.number = number;
    ASSERT_EQ(side.send(std::make_shared<const WorldUpdate>(update)), PushResult::kAccepted);
  }
  ASSERT_EQ(side.send(Quality{2}), PushResult::kAccepted);
  node.reset();
  ASSERT_TRUE(side.becomes(State::kLost));
  EXPECT_EQ(side.send(examples::request()), PushResult::kClosed);
  WorldUpdate newest = examples::world();
  newest.number = 4;
  EXPECT_EQ(side.send(std::make_shared<const WorldUpdate>(newest)), PushResult::kClosed);
  node = std::make_unique<NodeProcess>(port);
  ASSERT_TRUE(side.becomes(State::kWelcomed));
  ASSERT_TRUE(eventually([&] { return node->end() && node->end()->count() == 3; }));
  const auto messages = node->end()->messages();
  EXPECT_EQ(std::get<NodeHello>(messages[0]).process, examples::hello().process);
  EXPECT_EQ(std::get<std::shared_ptr<const WorldUpdate>>(messages[1])->number, 4U);
  EXPECT_EQ(std::get<Quality>(messages[2]).step, 2);
}

TEST(GrpcLinks, CarryBytesUnchanged) {
  NodeProcess node;
  FrontendSide side(node.address());
  ASSERT_TRUE(side.isWelcomed());
  class Keeper final : public FrontendPort {
   public:
    void receive(ToFrontend message) override {
      const std::lock_guard lock(mutex);
      if (auto* result = std::get_if<Result>(&message)) packed = result->packed;
    }
    std::shared_ptr<const PackedBytes> kept() {
      const std::lock_guard lock(mutex);
      return packed;
    }
    std::mutex mutex;
    std::shared_ptr<const PackedBytes> packed;
  } keeper;
  side.link().connect(keeper);
  for (const std::size_t size : {0U, 1U, 70'000U, 20'000'000U}) {
    PackedBytes bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 % 251);
    Result result = examples::sharedData();
    result.packed = std::make_shared<const PackedBytes>(bytes);
    node.end()->link().send(ToFrontend(result));
    EXPECT_TRUE(eventually([&] { return keeper.kept() && *keeper.kept() == bytes; })) << size;
  }
  side.link().leaveFrontend();
}

TEST(GrpcLinks, ResultsAreNotCopied) {
  NodeProcess node;
  FrontendSide side(node.address());
  ASSERT_TRUE(side.isWelcomed());
  auto bulk = std::make_shared<PackedBytes>(std::size_t{1} << 20U);
  const std::weak_ptr<const PackedBytes> watched = bulk;
  Result result = examples::sharedData();
  result.packed = std::move(bulk);
  node.end()->link().send(ToFrontend(std::move(result)));
  EXPECT_TRUE(eventually([&] { return watched.expired(); })) << "it is let go when it is sent";
  EXPECT_TRUE(eventually([&] { return side.count() == 2; }));
}

TEST(GrpcLinks, StuckPeerFillsOnlyItsOwnLink) {
  NodeProcess node;
  FrontendSide slow(node.address());
  FrontendSide other(node.address());
  ASSERT_TRUE(slow.isWelcomed());
  ASSERT_TRUE(
      eventually([&] { return node.end(0) && node.end(1) && node.end(0)->count() + node.end(1)->count() == 1; }));
  const auto its = node.end(node.end(0)->count() == 1 ? 0 : 1);
  ASSERT_TRUE(other.isWelcomed());
  slow.isHeld = true;
  Result result = examples::sharedData();
  constexpr std::size_t kMessage = std::size_t{4} << 20U;
  result.packed = std::make_shared<const PackedBytes>(kMessage);
  std::size_t sent = 0;
  while (node.timeline.counters()["messages rejected by a full link"] == 0 && sent < 1000) {
    its->link().send(ToFrontend(result));
    ++sent;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GE(sent, kMaxWaitingBytes / kMessage) << "it takes what may wait, even if the transport takes nothing";
  EXPECT_LT(sent, 100) << "a link without a bound";
  EXPECT_EQ(other.send(Quality{1}), PushResult::kAccepted);
  const auto others = node.end(0) == its ? node.end(1) : node.end(0);
  EXPECT_TRUE(eventually([&] { return others->count() == 2; }));
  slow.isHeld = false;
  EXPECT_TRUE(eventually([&] { return slow.count() == sent; })) << "all but the one that was counted arrives";
}

TEST(GrpcLinks, StuckNodeRefusesInTime) {
  NodeProcess node;
  FrontendSide side(node.address());
  ASSERT_TRUE(side.isWelcomed());
  node.end()->isHeld = true;
  int sent = 0;
  const ToBackend view = examples::toBackend()[2];
  const auto fits = [&] { return side.send(view) == PushResult::kAccepted; };
  // What is under way in the sockets' buffers fits, too.
  while (sent < 2'000'000 && (fits() || (std::this_thread::sleep_for(std::chrono::milliseconds(50)), fits()))) ++sent;
  EXPECT_LT(sent, 2'000'000) << "a queue without a bound";
  node.end()->isHeld = false;
  EXPECT_TRUE(eventually([&] { return node.end()->count() == 1U + static_cast<std::size_t>(sent); }))
      << "what was accepted arrives";
}

TEST(GrpcLinks, OversizedMessagesAreNotSent) {
  NodeProcess node;
  FrontendSide side(node.address());
  ASSERT_TRUE(side.isWelcomed());
  Result result = examples::sharedData();
  result.packed = std::make_shared<const PackedBytes>(kMaxMessageBytes);
  node.end()->link().send(ToFrontend(result));
  EXPECT_EQ(node.timeline.counters()["messages rejected by a full link"], 1);
  node.end()->link().send(ToFrontend(examples::sharedData()));
  EXPECT_TRUE(eventually([&] { return side.count() == 2; })) << "the link stands";
}

TEST(GrpcLinks, PortInUseIsOneClearError) {
  const NodeProcess node;
  try {
    const NodeProcess second(node.port());
    FAIL() << "two listen at one port";
  } catch (const EnvironmentError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr(node.address() + ": cannot listen"));
  }
}

TEST(GrpcLinks, UnservedLinkCostsOthersNothing) {
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers{1};
  std::atomic<int> asked{0};
  const GrpcServer server(
      "127.0.0.1:0",
      [&](std::shared_ptr<BackendEnd> link) -> std::shared_ptr<void> {
        if (++asked == 1) throw std::runtime_error("no memory");
        return std::make_shared<NodeEnd>(std::move(link));
      },
      workers, timeline);
  FrontendSide side("127.0.0.1:" + std::to_string(server.port()));
  EXPECT_TRUE(side.isWelcomed()) << "the first call failed";
  EXPECT_EQ(asked, 2);
}

TEST(GrpcLinks, ReportTheirPace) {
  auto node = std::make_unique<NodeProcess>();
  FrontendSide side(node->address());
  ASSERT_TRUE(side.isWelcomed());
  const auto travels = [&] {
    (void)side.send(Quality{1});
    node->end()->link().send(ToFrontend(examples::sharedData()));
    const LinkPace pace = side.link().pace();
    return pace.roundTrip && pace.sent > 0.0 && pace.received > 0.0;
  };
  EXPECT_TRUE(eventually(travels));
  EXPECT_GT(side.link().pace().roundTrip, 0.0);
  node.reset();
  EXPECT_TRUE(eventually([&] { return !side.link().pace().roundTrip; })) << "of a link that is gone nothing is known";
}

TEST(GrpcLinks, CloseDuringConnect) {
  for (int i = 0; i < 10; ++i) {
    const NodeProcess node;
    FrontendSide there(node.address());
    FrontendSide nowhere("127.0.0.1:1");
    if (i % 2 == 1) std::this_thread::sleep_for(std::chrono::milliseconds(i));
  }
}

}  // namespace
}  // namespace grove::node
