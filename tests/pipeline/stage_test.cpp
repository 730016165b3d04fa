#include "pipeline/stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <set>
#include <thread>

#include "eventually.h"
#include "pipeline/outlet.h"
#include "pipeline/worker_pool.h"

namespace grove::pipeline {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using tests::eventually;

/// Adds one to what it gets; -1 makes it throw.
class AddOne final : public Stage<int> {
 public:
  using Stage::Stage;
  Outlet<int> out;
  void connect(std::shared_ptr<Inlet<int>> to) {
    out.connect(std::move(to));
    addOutlet(out);
  }

 protected:
  void process(std::span<int> items, Run& run) override {
    for (const int item : items) {
      if (item == -1) throw std::runtime_error("minus one");
      out.send(run, item + 1);
    }
  }
  void recover(int& item, const std::string&, Run& run) override { out.send(run, item - 1000); }
};

/// Keeps what it gets, slowly if told so.
class Collect final : public Stage<int> {
 public:
  using Stage::Stage;
  std::vector<int> values() {
    const std::lock_guard lock(mutex_);
    return values_;
  }
  std::atomic<int> delayMilliseconds{0};
  std::atomic<std::size_t> maxQueued{0};
  std::atomic<std::size_t> largestBatch{0};

 protected:
  void process(std::span<int> items, Run&) override {
    if (queued() > maxQueued) maxQueued = queued();
    if (items.size() > largestBatch) largestBatch = items.size();
    if (delayMilliseconds > 0) std::this_thread::sleep_for(delayMilliseconds.load() * 1ms);
    const std::lock_guard lock(mutex_);
    values_.insert(values_.end(), items.begin(), items.end());
  }

 private:
  std::mutex mutex_;
  std::vector<int> values_;
};

/// Has no room when first asked, and room as soon as it has said so, before who asked does anything else.
class RoomAtOnce final : public Inlet<int> {
 public:
  PushResult push(int) override { return PushResult::kRejected; }
  bool tryReserve(std::function<void()> onRoom) override {
    if (asked_.exchange(true)) return true;
    onRoom();
    return false;
  }
  void cancelReservation() override {}
  PushResult pushReserved(int value) override {
    got = value;
    return PushResult::kAccepted;
  }
  std::atomic<int> got{0};

 private:
  std::atomic<bool> asked_{false};
};

/// Two runs wait for each other.
class Meet final : public Stage<int> {
 public:
  using Stage::Stage;
  std::latch both{2};
  std::atomic<int> met{0};

 protected:
  void process(std::span<int>, Run&) override {
    both.arrive_and_wait();
    ++met;
  }
};

StageOptions named(const char* name, std::size_t capacity) {
  StageOptions options;
  options.name = name;
  options.capacity = capacity;
  return options;
}

TEST(Stage, SerialStagesKeepTheOrder) {
  Timeline timeline;
  WorkerPool pool(4);
  const auto add = std::make_shared<AddOne>(named("add", 200), pool, timeline);
  const auto collect = std::make_shared<Collect>(named("collect", 200), pool, timeline);
  add->connect(collect);
  std::vector<int> expected;
  for (int i = 0; i < 200; ++i) {
    ASSERT_EQ(add->push(i), PushResult::kAccepted);
    expected.push_back(i + 1);
  }
  ASSERT_TRUE(eventually([&] { return collect->values().size() == 200; }));
  EXPECT_EQ(collect->values(), expected);
}

TEST(Stage, FullSuccessorAppliesBackPressure) {
  Timeline timeline;
  WorkerPool pool(3);
  const auto add = std::make_shared<AddOne>(named("add", 4), pool, timeline);
  const auto collect = std::make_shared<Collect>(named("collect", 2), pool, timeline);
  collect->delayMilliseconds = 1;
  add->connect(collect);
  for (int i = 0; i < 100;) {
    if (add->push(i) == PushResult::kAccepted) {
      ++i;
    } else {
      std::this_thread::sleep_for(200us);
    }
    EXPECT_LE(collect->queued(), 2u);
  }
  ASSERT_TRUE(eventually([&] { return collect->values().size() == 100; })) << "nothing may be lost by back-pressure";
  EXPECT_LE(collect->maxQueued, 2u);
}

// The run that found no room is still under way when it is told of some.
TEST(Stage, ConcurrentRoomIsNotMissed) {
  Timeline timeline;
  WorkerPool pool(1);
  const auto add = std::make_shared<AddOne>(named("add", 4), pool, timeline);
  const auto next = std::make_shared<RoomAtOnce>();
  add->connect(next);
  add->push(1);
  EXPECT_TRUE(eventually([&] { return next->got == 2; }));
}

TEST(Stage, ExceptionEndsOnlyItsRun) {
  Timeline timeline;
  WorkerPool pool(2);
  const auto add = std::make_shared<AddOne>(named("add", 8), pool, timeline);
  const auto collect = std::make_shared<Collect>(named("collect", 8), pool, timeline);
  add->connect(collect);
  add->push(1);
  add->push(-1);
  add->push(5);
  ASSERT_TRUE(eventually([&] { return collect->values().size() == 3; }));
  EXPECT_THAT(collect->values(), ElementsAre(2, -1001, 6));
  EXPECT_EQ(timeline.totals().at("add").failures, 1u);
}

TEST(Stage, ConcurrentStagesRunInParallel) {
  Timeline timeline;
  WorkerPool pool(2);
  StageOptions options = named("meet", 4);
  options.concurrency = 2;
  const auto meet = std::make_shared<Meet>(options, pool, timeline);
  meet->push(1);
  meet->push(2);
  EXPECT_TRUE(eventually([&] { return meet->met == 2; }));
}

TEST(Stage, BatchesQueuedInput) {
  Timeline timeline;
  WorkerPool pool(1);
  StageOptions options = named("collect", 16);
  options.maxBatch = 8;
  const auto collect = std::make_shared<Collect>(options, pool, timeline);
  collect->delayMilliseconds = 20;
  for (int i = 0; i < 12; ++i) collect->push(i);
  ASSERT_TRUE(eventually([&] { return collect->values().size() == 12; }));
  EXPECT_GT(collect->largestBatch, 1u);
  EXPECT_LE(collect->largestBatch, 8u);
}

TEST(Stage, BatchFitsTheOutlet) {
  Timeline timeline;
  WorkerPool pool(2);
  StageOptions options = named("add", 16);
  options.maxBatch = 8;
  const auto add = std::make_shared<AddOne>(options, pool, timeline);
  const auto collect = std::make_shared<Collect>(named("collect", 3), pool, timeline);
  collect->delayMilliseconds = 1;
  add->connect(collect);
  for (int i = 0; i < 16; ++i) add->push(i);
  ASSERT_TRUE(eventually([&] { return collect->values().size() == 16; }));
  EXPECT_LE(collect->maxQueued, 3u);
}

TEST(Stage, CloseDropsTheQueue) {
  Timeline timeline;
  std::weak_ptr<AddOne> wasAdd;
  std::shared_ptr<Collect> collect;
  {
    WorkerPool pool(2);
    const auto add = std::make_shared<AddOne>(named("add", 64), pool, timeline);
    wasAdd = add;
    collect = std::make_shared<Collect>(named("collect", 1), pool, timeline);
    collect->delayMilliseconds = 2;
    add->connect(collect);
    for (int i = 0; i < 64; ++i) add->push(i);
    add->close();
    collect->close();
    EXPECT_EQ(add->push(1), PushResult::kClosed);
    EXPECT_EQ(add->queued(), 0U);
  }
  EXPECT_LT(collect->values().size(), 64U) << "what was queued is dropped";
  EXPECT_TRUE(wasAdd.expired()) << "no task that is left holds the stage";
}

/// Or the frames that have begun wait behind those that have not.
TEST(Stage, FinishersGoFirst) {
  Timeline timeline;
  WorkerPool pool(1);
  StageOptions last = named("last", 16);
  last.finishes = true;
  const auto begins = std::make_shared<Collect>(named("first", 16), pool, timeline);
  const auto finishes = std::make_shared<Collect>(last, pool, timeline);
  std::promise<void> release;
  pool.post([released = release.get_future().share()] { released.wait(); });
  begins->push(1);
  finishes->push(2);
  release.set_value();
  pool.drain();
  const auto events = timeline.events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_STREQ(events[0].stage, "last");
  EXPECT_STREQ(events[1].stage, "first");
}

TEST(Stage, IsIdleWhenDone) {
  Timeline timeline;
  WorkerPool pool(2);
  const auto collect = std::make_shared<Collect>(named("collect", 4), pool, timeline);
  EXPECT_TRUE(collect->idle());
  collect->delayMilliseconds = 2;
  for (std::size_t done = 1; done <= 20; ++done) {
    collect->push(0);
    while (!collect->idle()) std::this_thread::yield();
    ASSERT_EQ(collect->values().size(), done) << "idle before its work was done";
  }
}

TEST(Stage, EveryRunIsRecorded) {
  Timeline timeline;
  {
    WorkerPool pool(1);
    StageOptions options = named("collect", 4);
    options.work = Work::kPerUserFrontend;
    const auto collect = std::make_shared<Collect>(options, pool, timeline);
    collect->delayMilliseconds = 5;
    collect->push(1);
  }
  const auto events = timeline.events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_STREQ(events[0].stage, "collect");
  EXPECT_EQ(events[0].work, Work::kPerUserFrontend);
  EXPECT_GE(events[0].wallNanoseconds, 5'000'000);
  EXPECT_LT(events[0].cpuNanoseconds, events[0].wallNanoseconds) << "sleeping is not CPU time";
}

TEST(WorkerPool, ThreadsDoNotGrowWithTasks) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  {
    WorkerPool pool(3);
    for (int i = 0; i < 500; ++i) {
      pool.post([&] {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
      });
    }
  }
  EXPECT_LE(seen.size(), 3u);
}

}  // namespace
}  // namespace grove::pipeline
