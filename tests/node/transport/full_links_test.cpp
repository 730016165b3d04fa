#include <gtest/gtest.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

#include "eventually.h"
#include "node/messages/examples.h"
#include "node/transport/transports_fixture.h"

namespace grove::node {
namespace {

using testing::Mailbox;
using testing::Transports;
using tests::eventually;

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

/// Without that by reference, where nothing waits.
class FullLinks : public Transports {};

/// Would catch a quality that stays as it was, or a visitor who is never forgotten, because a link was full for a
/// moment.
TEST_P(FullLinks, ControlMessagesWaitForRoom) {
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
  const SharedKey fire{.object = 4, .key = {}};
  for (const Version version : {4U, 8U}) {
    EXPECT_EQ(transport->send(ToBackend(Acknowledgement{fire, version})), pipeline::PushResult::kAccepted);
  }
  EXPECT_EQ(transport->send(ToBackend(Unsubscribe{fire})), pipeline::PushResult::kAccepted);
  held.release();
  EXPECT_TRUE(eventually([&] { return only<Forget>(held.messages()).size() == 1; }));
  EXPECT_TRUE(eventually([&] { return !only<Quality>(held.messages()).empty(); }));
  EXPECT_EQ(only<Quality>(held.messages()).back().step, 0) << "the newest counts";
  EXPECT_LT(only<Quality>(held.messages()).size(), 3U) << "older ones have no use";
  EXPECT_EQ(only<Cancel>(held.messages()).back().frame, 9U);
  EXPECT_TRUE(eventually([&] { return only<Unsubscribe>(held.messages()).size() == 1; }));
  EXPECT_EQ(only<Acknowledgement>(held.messages()).back().version, 8U);
  transport->leaveBackend();
  transport->connect(backend);
}

TEST_P(FullLinks, AnnouncementsWaitForRoom) {
  HeldFrontend held;
  transport->connect(held);
  if (GetParam() == TransportKind::kGrpc) {
    (void)transport->send(ToBackend(examples::hello()));  // a stream begins with it
    ASSERT_TRUE(eventually([&] { return backend.count() > 0; }));
  }
  const auto full = [&] { return timeline.counters()["messages rejected by a full link"] > 0; };
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

INSTANTIATE_TEST_SUITE_P(OverEach, FullLinks, testing::kAllWires, testing::transportName);

}  // namespace
}  // namespace grove::node
