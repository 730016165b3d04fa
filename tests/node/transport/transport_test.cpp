#include "node/transport/transport.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "eventually.h"
#include "node/messages/examples.h"
#include "node/tested_transports.h"
#include "node/transport/bytes_transport.h"
#include "pipeline/worker_pool.h"

namespace grove::node {
namespace {

using tests::eventually;

/// Keeps what it gets.
template <class Port, class Message>
class Mailbox : public Port {
 public:
  [[nodiscard]] std::vector<Message> messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  [[nodiscard]] std::size_t count() const { return messages().size(); }

 protected:
  void keep(Message message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Message> messages_;
};

class Backend final : public Mailbox<BackendPort, ToBackend> {
 public:
  std::atomic<pipeline::PushResult> answer = pipeline::PushResult::kAccepted;
  pipeline::PushResult receive(ToBackend message) override {
    keep(std::move(message));
    return answer;
  }
};

class Frontend final : public Mailbox<FrontendPort, ToFrontend> {
 public:
  void receive(ToFrontend message) override { keep(std::move(message)); }
};

class Transports : public ::testing::TestWithParam<TransportKind> {
 public:
  Transports() {
    transport->connect(backend);
    transport->connect(frontend);
  }
  ~Transports() override {
    transport->leaveFrontend();
    transport->leaveBackend();
    workers.drain();
  }

 protected:
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers{3};
  Backend backend;
  Frontend frontend;
  const std::unique_ptr<Transport> transport = transportFactory(GetParam())(workers, timeline);
};

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

/// Receives nothing until it is released.
template <class Port>
class Held : public Port {
 public:
  void release() {
    {
      const std::lock_guard lock(mutex_);
      isReleased_ = true;
    }
    released_.notify_all();
  }

 protected:
  void wait() {
    std::unique_lock lock(mutex_);
    released_.wait(lock, [this] { return isReleased_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable released_;
  bool isReleased_ = false;
};

class HeldBackend final : public Held<Mailbox<BackendPort, ToBackend>> {
 public:
  pipeline::PushResult receive(ToBackend message) override {
    wait();
    keep(std::move(message));
    return pipeline::PushResult::kAccepted;
  }
};

class HeldFrontend final : public Held<Mailbox<FrontendPort, ToFrontend>> {
 public:
  void receive(ToFrontend message) override {
    wait();
    keep(std::move(message));
  }
};

template <class Wanted, class Message>
std::vector<Wanted> only(const std::vector<Message>& messages) {
  std::vector<Wanted> found;
  for (const Message& message : messages) {
    if (const auto* wanted = std::get_if<Wanted>(&message)) found.push_back(*wanted);
  }
  return found;
}

/// Would catch a quality that stays as it was, or a visitor who is never forgotten, because a link was full for a
/// moment.
/// Nothing waits where messages go by reference.
class FullLinks : public Transports {};

TEST_P(FullLinks, ControlMessagesWaitBesideAFullLink) {
  HeldBackend held;
  transport->connect(held);
  const auto view = std::get<std::shared_ptr<const View>>(examples::toBackend()[2]);
  int sent = 0;
  while (transport->send(ToBackend(view)) == pipeline::PushResult::kAccepted && sent < 1'000'000) ++sent;
  ASSERT_LT(sent, 1'000'000) << "it is never full";
  for (const int step : {1, 2, 0}) {
    EXPECT_EQ(transport->send(ToBackend(Quality{step})), pipeline::PushResult::kAccepted);
  }
  for (const FrameNumber frame : {7U, 9U}) {
    EXPECT_EQ(transport->send(ToBackend(Cancel{makeId(1, 1), frame})), pipeline::PushResult::kAccepted);
  }
  EXPECT_EQ(transport->send(ToBackend(Forget{makeId(1, 1)})), pipeline::PushResult::kAccepted);
  held.release();
  EXPECT_TRUE(eventually([&] { return only<Forget>(held.messages()).size() == 1; }));
  EXPECT_TRUE(eventually([&] { return !only<Quality>(held.messages()).empty(); }));
  EXPECT_EQ(only<Quality>(held.messages()).back().step, 0) << "the newest counts";
  EXPECT_LT(only<Quality>(held.messages()).size(), 3U) << "older ones have no use";
  EXPECT_EQ(only<Cancel>(held.messages()).back().frame, 9U);
  transport->leaveBackend();
  transport->connect(backend);
}

TEST_P(FullLinks, AnnouncementsWaitBesideAFullLink) {
  HeldFrontend held;
  transport->connect(held);
  if (GetParam() == TransportKind::kGrpc) {
    (void)transport->send(ToBackend(examples::hello()));  // a stream begins with it
    ASSERT_TRUE(eventually([&] { return backend.count() > 0; }));
  }
  const auto full = [&] { return timeline.counters()["messages that found their link full"] > 0; };
  for (int sent = 0; sent < 1'000'000 && !full(); ++sent) transport->send(ToFrontend(examples::failure()));
  ASSERT_TRUE(full());
  for (const Version version : {2U, 3U}) {
    transport->send(ToFrontend(Announcement{.what = {.object = 4, .key = "a"}, .version = version}));
    transport->send(ToFrontend(Announcement{.what = {.object = 4, .key = "b"}, .version = version}));
  }
  held.release();
  const auto newest = [&](const Key& key) {
    Version version = 0;
    for (const Announcement& announcement : only<Announcement>(held.messages())) {
      if (announcement.what.key == key) version = announcement.version;
    }
    return version;
  };
  EXPECT_TRUE(eventually([&] { return newest("a") == 3 && newest("b") == 3; }));
  transport->leaveFrontend();
  transport->connect(frontend);
}

TEST_P(Transports, WhoHasLeftGetsNothing) {
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
TEST_P(Transports, WhoReceivesMaySendWhileTheOtherDoes) {
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

INSTANTIATE_TEST_SUITE_P(OverEach, FullLinks, testing::kAllWires, testing::transportName);
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

TEST_F(BytesTransportTest, ARequestThatTheNodeRefusesFails) {
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

TEST_F(BytesTransportTest, ARequestWithoutItsViewIsRefused) {
  (void)transport.send(ToBackend(examples::request()));
  EXPECT_TRUE(eventually([&] { return timeline.counters()["messages that were refused"] == 1; }));
  EXPECT_EQ(backend.count(), 0u);
}

/// Or who is not welcome at a node could fill its memory all the same.
TEST_F(BytesTransportTest, AViewThatTheNodeRefusesIsNotKept) {
  backend.answer = pipeline::PushResult::kClosed;
  (void)transport.send(ToBackend(examples::request().view));
  (void)transport.send(ToBackend(examples::request()));
  EXPECT_TRUE(eventually([&] { return timeline.counters()["messages that were refused"] == 1; }));
  EXPECT_EQ(backend.count(), 1U);
}

TEST_F(BytesTransportTest, CountsWhatTravels) {
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

TEST_F(BytesTransportTest, RefusesWhatDoesNotFit) {
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
