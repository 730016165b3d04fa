#include "node/transport/transport.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "eventually.h"
#include "node/messages/examples.h"
#include "node/transport/bytes_transport.h"
#include "node/transport/transports_fixture.h"

namespace grove::node {
namespace {

using testing::Backend;
using testing::Frontend;
using testing::Transports;
using tests::eventually;

TEST_P(Transports, CarryEveryMessageInOrder) {
  for (int round = 0; round < 50; ++round) {
    for (const ToBackend& message : examples::toBackend()) {
      ASSERT_EQ(transport->send(message), pipeline::PushResult::kAccepted);
    }
    for (const ToFrontend& message : examples::toFrontend()) transport->send(message);
  }
  const std::vector<ToBackend> toBackend = examples::toBackend();
  const std::vector<ToFrontend> toFrontend = examples::toFrontend();
  ASSERT_TRUE(eventually([&] { return backend.count() >= 50 * toBackend.size(); })) << backend.count();
  ASSERT_TRUE(eventually([&] { return frontend.count() == 50 * toFrontend.size(); })) << frontend.count();
  const auto atBackend = backend.messages();
  // One that is refused may greet again.
  for (std::size_t i = 0; i < 50 * toBackend.size(); ++i) {
    ASSERT_EQ(atBackend[i].index(), toBackend[i % toBackend.size()].index());
  }
  const auto atFrontend = frontend.messages();
  for (std::size_t i = 0; i < atFrontend.size(); ++i) {
    ASSERT_EQ(atFrontend[i].index(), toFrontend[i % toFrontend.size()].index());
  }
}

TEST_P(Transports, DepartedPeersGetNothing) {
  transport->leaveBackend();
  transport->leaveFrontend();
  (void)transport->send(ToBackend(Quality{1}));
  transport->send(ToFrontend(examples::failure()));
  workers.drain();
  EXPECT_EQ(backend.count(), 0u);
  EXPECT_EQ(frontend.count(), 0u);
  transport->connect(backend);
  transport->connect(frontend);
}

/// Answers every other message with one of its own.
class AnsweringBackend final : public BackendPort {
 public:
  explicit AnsweringBackend(Transport& transport) : transport_(transport) {}
  pipeline::PushResult receive(ToBackend /*message*/) override {
    if (received++ % 2 == 0) transport_.send(ToFrontend(examples::failure()));
    return pipeline::PushResult::kAccepted;
  }
  std::atomic<int> received = 0;

 private:
  Transport& transport_;
};

class AnsweringFrontend final : public FrontendPort {
 public:
  explicit AnsweringFrontend(Transport& transport) : transport_(transport) {}
  void receive(ToFrontend /*message*/) override {
    if (received++ % 2 == 0) (void)transport_.send(ToBackend(Quality{1}));
  }
  std::atomic<int> received = 0;

 private:
  Transport& transport_;
};

/// For the thread sanitizer: whoever holds a lock of one end while he sends to the other waits for one who does it the
/// other way round, as soon as somebody leaves.
TEST_P(Transports, BothEndsMaySendConcurrently) {
  constexpr int kMessages = 200;
  AnsweringBackend answeringBackend(*transport);
  AnsweringFrontend answeringFrontend(*transport);
  transport->connect(answeringBackend);
  transport->connect(answeringFrontend);
  std::thread other([&] {
    for (int i = 0; i < kMessages; ++i) transport->send(ToFrontend(examples::failure()));
  });
  for (int i = 0; i < kMessages; ++i) (void)transport->send(ToBackend(Quality{1}));
  other.join();
  EXPECT_TRUE(
      eventually([&] { return answeringBackend.received > kMessages && answeringFrontend.received > kMessages; }));
  transport->leaveFrontend();
  transport->leaveBackend();
  workers.drain();
}

INSTANTIATE_TEST_SUITE_P(OverEach, Transports, testing::kAllTransports, testing::transportName);

class BytesTransportTest : public ::testing::Test {
 public:
  BytesTransportTest() {
    transport.connect(backend);
    transport.connect(frontend);
  }
  ~BytesTransportTest() override {
    transport.leaveFrontend();
    transport.leaveBackend();
    workers.drain();
  }

 protected:
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers{2};
  Backend backend;
  Frontend frontend;
  BytesTransport transport{workers, timeline};
};

TEST_F(BytesTransportTest, RefusedRequestsFail) {
  const Request request = examples::request();
  ASSERT_EQ(transport.send(ToBackend(request.view)), pipeline::PushResult::kAccepted);
  ASSERT_TRUE(eventually([&] { return backend.count() == 1; }));
  backend.answer = pipeline::PushResult::kRejected;
  ASSERT_EQ(transport.send(ToBackend(request)), pipeline::PushResult::kAccepted);
  ASSERT_TRUE(eventually([&] { return frontend.count() == 1; }));
  const auto messages = frontend.messages();
  const Result& result = std::get<Result>(messages[0]);
  EXPECT_EQ(result.session, request.view->session);
  EXPECT_EQ(result.slot, request.slot);
  EXPECT_TRUE(std::get<Failure>(result.payload).notNow);
}

TEST_F(BytesTransportTest, RefusesARequestWithoutItsView) {
  (void)transport.send(ToBackend(examples::request()));
  EXPECT_TRUE(eventually([&] { return timeline.counters()["refused messages"] == 1; }));
  EXPECT_EQ(backend.count(), 0u);
}

/// Or who is not welcome at a node could fill its memory all the same.
TEST_F(BytesTransportTest, DoesNotKeepRefusedViews) {
  backend.answer = pipeline::PushResult::kClosed;
  (void)transport.send(ToBackend(examples::request().view));
  (void)transport.send(ToBackend(examples::request()));
  EXPECT_TRUE(eventually([&] { return timeline.counters()["refused messages"] == 1; }));
  EXPECT_EQ(backend.count(), 1U);
}

TEST_F(BytesTransportTest, CountsBytes) {
  transport.send(ToFrontend(examples::picture()));
  transport.send(ToFrontend(examples::sharedData()));
  (void)transport.send(ToBackend(Quality{2}));
  const LinkTraffic traffic = transport.traffic();
  EXPECT_EQ(traffic.pictures, examples::bulk()->size());
  EXPECT_EQ(traffic.sharedData, examples::bulk()->size());
  EXPECT_GT(traffic.headers, 0u);
  EXPECT_GT(traffic.toBackend, 0u);
}

/// Holds its worker until it is let go.
class SlowBackend final : public BackendPort {
 public:
  pipeline::PushResult receive(ToBackend) override {
    while (!go) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ++received;
    return pipeline::PushResult::kAccepted;
  }
  std::atomic<bool> go{false};
  std::atomic<int> received{0};
};

TEST_F(BytesTransportTest, RefusesOversizedMessages) {
  SlowBackend slow;
  transport.connect(slow);
  const ToBackend view = examples::toBackend()[2];
  int sent = 0;
  while (sent < 10'000 && transport.send(view) == pipeline::PushResult::kAccepted) ++sent;
  EXPECT_GE(sent, 4096);
  EXPECT_LT(sent, 10'000) << "a queue without a bound";
  slow.go = true;
  EXPECT_TRUE(eventually([&] { return slow.received == sent; })) << "what was accepted arrives";
  transport.leaveBackend();
}

}  // namespace
}  // namespace grove::node
