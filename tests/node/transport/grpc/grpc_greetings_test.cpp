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

TEST(GrpcGreetings, RefusedPeerGreetsAgain) {
  NodeProcess node(0, "the scenes differ");
  FrontendSide side(node.address());
  (void)side.send(examples::hello());
  ASSERT_TRUE(side.becomes(State::kRefused));
  EXPECT_EQ(side.link().status().reason, "the scenes differ");
  EXPECT_TRUE(eventually([&] { return node.end()->count() >= 2; })) << "the node may change its mind";
}

/// A stream that has ended while what it brought waited for a worker.
class LateAnswers : public ::testing::Test {
 protected:
  void hearTooLate(const std::string& refusal) {
    auto node = std::make_unique<NodeProcess>(0, refusal);
    port = node->port();
    side = std::make_unique<FrontendSide>(node->address());
    side->isHeld = true;
    (void)side->send(examples::hello());
    ASSERT_TRUE(eventually([&] { return side->link().traffic().headers > 0; }));
    node.reset();
    ASSERT_TRUE(eventually([&] { return !side->link().status().reason.empty(); })) << "why it has ended";
    side->isHeld = false;
    side->workers.drain();
    ASSERT_EQ(side->count(), 1U);
  }

  int port = 0;
  std::unique_ptr<FrontendSide> side;
};

/// The greeting that follows a refusal must not take the place of the next call.
TEST_F(LateAnswers, RefusalDoesNotEndRetries) {
  ASSERT_NO_FATAL_FAILURE(hearTooLate("the scenes differ"));
  const NodeProcess node(port);
  EXPECT_TRUE(side->becomes(State::kWelcomed));
}

TEST_F(LateAnswers, WelcomeIsNotLate) {
  ASSERT_NO_FATAL_FAILURE(hearTooLate(""));
  EXPECT_EQ(side->link().status().state, State::kConnecting);
}

/// Or a process whose workers are busy would never have a link.
TEST(GrpcGreetings, DelayedWelcomeCounts) {
  NodeProcess node;
  FrontendSide side(node.address());
  side.isHeld = true;
  (void)side.send(examples::hello());
  ASSERT_TRUE(eventually([&] { return side.link().traffic().headers > 0; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(kAnswerMilliseconds + 1000));
  EXPECT_EQ(side.link().status().state, State::kConnecting) << "it is not silent";
  side.isHeld = false;
  EXPECT_TRUE(side.becomes(State::kWelcomed));
  EXPECT_EQ(node.end(1), nullptr) << "it was called once";
}

/// Takes what comes, and says nothing.
class MuteEnd final : public BackendPort {
 public:
  explicit MuteEnd(std::shared_ptr<BackendEnd> link) : link_(std::move(link)) { link_->connect(*this); }
  ~MuteEnd() override { link_->leaveBackend(); }
  MuteEnd(const MuteEnd&) = delete;
  MuteEnd& operator=(const MuteEnd&) = delete;
  PushResult receive(ToBackend /*message*/) override { return PushResult::kAccepted; }

 private:
  const std::shared_ptr<BackendEnd> link_;
};

TEST(GrpcGreetings, SilentNodeIsCalledAgain) {
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers{1};
  std::atomic<int> calls{0};
  const GrpcServer server(
      "127.0.0.1:0",
      [&](std::shared_ptr<BackendEnd> link) -> std::shared_ptr<void> {
        if (++calls == 1) return std::make_shared<MuteEnd>(std::move(link));
        return std::make_shared<NodeEnd>(std::move(link));
      },
      workers, timeline);
  FrontendSide side("127.0.0.1:" + std::to_string(server.port()));
  ASSERT_TRUE(side.link().waitUntilOpen(std::chrono::seconds(30)));
  std::this_thread::sleep_for(std::chrono::milliseconds(kAnswerMilliseconds + 1000));
  EXPECT_EQ(side.link().status().state, State::kConnecting) << "who has said nothing waits for no answer";
  EXPECT_EQ(side.send(examples::hello()), PushResult::kAccepted);
  EXPECT_TRUE(side.becomes(State::kSilent));
  EXPECT_THAT(side.link().status().reason, ::testing::HasSubstr("neither welcomes nor refuses"));
  EXPECT_TRUE(side.becomes(State::kWelcomed));
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace grove::node
