#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "eventually.h"
#include "integration/picture.h"
#include "integration/served_scene.h"
#include "node/transport/reference_transport.h"
#include "objects/fluid/common/snapshot.h"
#include "sanitized.h"
#include "stream/session/headless_session.h"

namespace grove::integration {
namespace {

using objects::fluid::FluidSnapshot;
using Snapshot = std::shared_ptr<const FluidSnapshot>;

const std::string kFire = std::string(R"(
name = "fire"
spawn = [0, 0, 6]
[visitor]
type = "figure"
[[object]]
type = "fluid"
size = 8
wind = [0, 0, 0]
)") + (kSanitized ? "grid = 16\n" : "grid = 32\n");

/// What simulations answered last, by the world that was made first, second...
class Answers {
 public:
  /// The number of a further world.
  [[nodiscard]] std::size_t addWorld() {
    const std::lock_guard lock(mutex_);
    newest_.emplace_back();
    return newest_.size();
  }
  [[nodiscard]] std::size_t worlds() const {
    const std::lock_guard lock(mutex_);
    return newest_.size();
  }
  void put(std::size_t world, Snapshot snapshot) {
    const std::lock_guard lock(mutex_);
    newest_[world - 1] = std::move(snapshot);
  }
  [[nodiscard]] Snapshot of(std::size_t world) const {
    const std::lock_guard lock(mutex_);
    return newest_.at(world - 1);
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Snapshot> newest_;
};

/// The wire of one process, with somebody listening in.
class TappedTransport final : public node::Transport {
 public:
  using Transport::connect;
  using Transport::send;
  explicit TappedTransport(std::shared_ptr<Answers> answers)
      : answers_(std::move(answers)), world_(answers_->addWorld()) {}
  [[nodiscard]] bool sharesMemory() const override { return true; }
  void connect(node::BackendPort& backend) override { wire_.connect(backend); }
  void connect(node::FrontendPort& frontend) override { wire_.connect(frontend); }
  void leaveBackend() override { wire_.leaveBackend(); }
  void leaveFrontend() override { wire_.leaveFrontend(); }
  pipeline::PushResult send(node::ToBackend message) override { return wire_.send(std::move(message)); }
  pipeline::PushResult send(node::ToFrontend message) override {
    if (const auto* result = std::get_if<node::Result>(&message)) {
      const auto* data = std::get_if<std::shared_ptr<const node::SharedData>>(&result->payload);
      if (data != nullptr) {
        if (auto snapshot = std::dynamic_pointer_cast<const FluidSnapshot>(*data)) {
          answers_->put(world_, std::move(snapshot));
        }
      }
    }
    return wire_.send(std::move(message));
  }
  void compress(node::Result& /*result*/, std::string_view /*subject*/) const override {}

 private:
  const std::shared_ptr<Answers> answers_;
  const std::size_t world_;
  node::ReferenceTransport wire_;
};

/// A fire whose answers are kept.
struct TappedFire : ServedScene {
  TappedFire(bool privateWorlds, const std::shared_ptr<Answers>& answers)
      : ServedScene(kFire, {.privateWorlds = privateWorlds}, [answers](pipeline::Executor&, pipeline::Timeline&) {
          return std::make_unique<TappedTransport>(answers);
        }) {}
};

/// Mean speed of the particles to one side; a gust makes it large.
double meanSpeedAlong(const FluidSnapshot& snapshot) {
  double sum = 0.0;
  for (const float speed : snapshot.velocityZ) sum += std::abs(static_cast<double>(speed));
  return sum / static_cast<double>(std::max<std::size_t>(1, snapshot.count()));
}

/// Two visitors, of whom the first blows at the fire for a while; what each has seen of it last.
struct Seen {
  Snapshot blower;
  Snapshot other;
  std::size_t worlds = 0;
};
Seen afterOneBlew(bool privateWorlds) {
  const auto answers = std::make_shared<Answers>();
  TappedFire served(privateWorlds, answers);
  stream::HeadlessSession a(served.host, "a", 160, 90);
  stream::HeadlessSession b(served.host, "b", 160, 90);
  EXPECT_TRUE(a.frameAfter(0, kPatience));
  EXPECT_TRUE(b.frameAfter(0, kPatience));
  a.control(world::kBlow, 0.0F, 0.0F);
  b.control(0, 0.0F, 0.0F);
  // A little more than a second of the world.
  const std::size_t worlds = answers->worlds();
  const std::uint64_t until = std::max(answers->of(1)->tick, answers->of(worlds)->tick) + 36;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  const auto tick = [&] { return std::min(answers->of(1)->tick, answers->of(worlds)->tick); };
  while (tick() < until && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(tick(), until);
  return {answers->of(1), answers->of(worlds), worlds};
}

TEST(PrivateWorlds, EachVisitorHasASimulationOfHisOwn) {
  const auto [blower, other, worlds] = afterOneBlew(true);
  ASSERT_EQ(worlds, 2U);
  EXPECT_GT(meanSpeedAlong(*blower), 2.0 * meanSpeedAlong(*other)) << "one's breath does not reach the other's fire";
}

TEST(PrivateWorlds, SharedOnesAreOne) {
  const double calm = meanSpeedAlong(*afterOneBlew(true).other);
  const Seen shared = afterOneBlew(false);
  EXPECT_EQ(shared.worlds, 1U) << "both see the same smoke";
  EXPECT_GT(meanSpeedAlong(*shared.other), 2.0 * calm);
}

TEST(PrivateWorlds, TickEachOnAClockOfItsOwn) {
  const auto answers = std::make_shared<Answers>();
  TappedFire served(true, answers);
  EXPECT_EQ(served.host.timeline().totals().count("Simulation Tick"), 0u) << "nobody is here, nothing ticks";
  auto a = std::make_unique<stream::HeadlessSession>(served.host, "a", 160, 90);
  stream::HeadlessSession b(served.host, "b", 160, 90);
  ASSERT_TRUE(a->frameAfter(0, kPatience));
  ASSERT_TRUE(b.frameAfter(0, kPatience));
  a.reset();  // takes his world along, and only his
  const Snapshot before = answers->of(2);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (answers->of(2)->tick < before->tick + 5 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_GE(answers->of(2)->tick, before->tick + 5);
}

TEST(PrivateWorlds, VisitorsStillMeet) {
  TappedFire served(true, std::make_shared<Answers>());
  stream::HeadlessSession a(served.host, "a", 160, 90);
  stream::HeadlessSession b(served.host, "b", 160, 90);
  const auto frame = a.frameAfter(0, kPatience);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->header.visitors, 2);
}

/// Of the process's threads, those that come after the calling one where time is short.
int threadsOfLessPriority() {
  int count = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    const auto thread = static_cast<id_t>(std::stoul(task.path().filename()));
    if (getpriority(PRIO_PROCESS, thread) > getpriority(PRIO_PROCESS, 0)) ++count;
  }
  return count;
}

TEST(PrivateWorlds, KeepNothingOfTheLowPriorityThatTheyWereMadeAt) {
  TappedFire served(true, std::make_shared<Answers>());
  stream::HeadlessSession a(served.host, "a", 160, 90);
  ASSERT_TRUE(a.frameAfter(0, kPatience));
  const int before = threadsOfLessPriority();  // some of a driver's have less
  stream::HeadlessSession b(served.host, "b", 160, 90);
  ASSERT_TRUE(b.frameAfter(0, kPatience));
  EXPECT_TRUE(tests::eventually([&] { return threadsOfLessPriority() == before; }))
      << "his smoke would move in slow motion";
}

TEST(PrivateWorlds, LetAVisitorGoWhoseWorldIsNotReady) {
  TappedFire served(true, std::make_shared<Answers>());
  for (int i = 0; i < 3; ++i) const stream::HeadlessSession gone(served.host, "gone", 160, 90);
  EXPECT_EQ(served.host.visitors(), 0u);
}

}  // namespace
}  // namespace grove::integration
