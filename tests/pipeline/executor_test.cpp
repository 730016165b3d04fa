#include "pipeline/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

#include "pipeline/worker_pool.h"

namespace grove::pipeline {
namespace {

// A private world that is torn down and the host that ends drain the same workers.
TEST(Executor, ManyThreadsDrainAtOnce) {
  WorkerPool pool(2);
  for (int round = 0; round < 2000; ++round) {
    std::atomic<int> done = 0;
    for (int i = 0; i < 4; ++i) pool.post([&] { ++done; });
    std::vector<std::jthread> threads;
    for (int i = 0; i < 3; ++i) {
      threads.emplace_back([&] {
        pool.drain();
        EXPECT_EQ(done, 4);
      });
    }
  }
}

TEST(Executor, DrainWaitsUntilWhatATaskHeldIsDestroyed) {
  WorkerPool pool(2);
  for (int round = 0; round < 2000; ++round) {
    auto held = std::make_shared<int>(round);
    const std::weak_ptr<int> watch = held;
    pool.post([held = std::move(held)] { std::this_thread::yield(); });
    pool.drain();
    ASSERT_TRUE(watch.expired());
  }
}

TEST(Executor, DrainHoldsUpNoOtherTask) {
  WorkerPool pool(2);
  std::promise<void> release;
  std::latch started(1);
  pool.post([&, released = release.get_future().share()] {
    started.count_down();
    released.wait();
  });
  started.wait();
  auto drained = std::async(std::launch::async, [&] { pool.drain(); });
  EXPECT_EQ(drained.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout) << "a task still runs";
  for (int i = 0; i < 100; ++i) {
    std::promise<void> ran;
    pool.post([&] { ran.set_value(); });
    ASSERT_EQ(ran.get_future().wait_for(std::chrono::seconds(10)), std::future_status::ready);
  }
  release.set_value();
  drained.get();
}

}  // namespace
}  // namespace grove::pipeline
