#include <gtest/gtest.h>

#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string>

#include "pipeline/outlet.h"
#include "pipeline/stage.h"
#include "pipeline/worker_pool.h"

/// A wake-up that is lost once in ten thousand times is only found by many tries: `deploy/test soak` sets GROVE_BURSTS.
namespace grove::pipeline {
namespace {

using namespace std::chrono_literals;

constexpr int kBurst = 236;
constexpr int kRoom = 60;

class Pass final : public Stage<int> {
 public:
  using Stage::Stage;
  Outlet<int> out;
  void connect(std::shared_ptr<Inlet<int>> to) {
    out.connect(std::move(to));
    addOutlet(out);
  }

 protected:
  void process(std::span<int> items, Run& run) override {
    for (const int item : items) out.send(run, item);
  }
};

class Count final : public Stage<int> {
 public:
  using Stage::Stage;
  /// Whether so many came within ten seconds.
  bool reaches(int count) {
    std::unique_lock lock(mutex_);
    wanted_ = count;
    return reached_.wait_for(lock, 10s, [&] { return count_ == count; });
  }

 protected:
  void process(std::span<int> items, Run&) override {
    const std::lock_guard lock(mutex_);
    count_ += static_cast<int>(items.size());
    if (count_ == wanted_) reached_.notify_one();
  }

 private:
  std::mutex mutex_;
  std::condition_variable reached_;
  int count_ = 0;
  int wanted_ = 0;
};

class Bursts : public testing::TestWithParam<int> {};

TEST_P(Bursts, LargerThanTheOutletArriveComplete) {
  const char* const reported = std::getenv("GROVE_BURSTS");
  const int bursts = reported ? std::stoi(reported) : 200;
  Timeline timeline;
  WorkerPool pool(GetParam());
  const auto pass = std::make_shared<Pass>(StageOptions{.name = "pass", .capacity = kBurst}, pool, timeline);
  const auto count = std::make_shared<Count>(StageOptions{.name = "count", .capacity = kRoom}, pool, timeline);
  pass->connect(count);
  for (int burst = 1; burst <= bursts; ++burst) {
    for (int i = 0; i < kBurst; ++i) ASSERT_EQ(pass->push(i), PushResult::kAccepted);
    ASSERT_TRUE(count->reaches(burst * kBurst)) << "burst " << burst << ": " << pass->queued() << " wait for room";
  }
}

INSTANTIATE_TEST_SUITE_P(Workers, Bursts, testing::Values(2, 16));

}  // namespace
}  // namespace grove::pipeline
