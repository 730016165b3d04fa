#include "pipeline/executor.h"

#include <gtest/gtest.h>

#include <algorithm>
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
TEST(Executor, ConcurrentDrains) {
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

TEST(Executor, DrainWaitsForDestructorsOfTasks) {
  WorkerPool pool(2);
  for (int round = 0; round < 2000; ++round) {
    auto held = std::make_shared<int>(round);
    const std::weak_ptr<int> watch = held;
    pool.post([held = std::move(held)] { std::this_thread::yield(); });
    pool.drain();
    ASSERT_TRUE(watch.expired());
  }
}

TEST(Executor, DrainDoesNotBlockOtherTasks) {
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

TEST(Executor, PostFirstGoesToTheFront) {
  WorkerPool pool(1);
  std::promise<void> release;
  pool.post([released = release.get_future().share()] { released.wait(); });
  std::vector<int> order;
  pool.post([&] { order.push_back(3); });
  pool.postFirst([&] { order.push_back(1); });
  pool.postFirst([&] { order.push_back(2); });
  release.set_value();
  pool.drain();
  EXPECT_EQ(order, (std::vector<int>{1, 2, 3}));
}

/// Fails if a frame that begins when a worker is idle would wait for ever.
TEST(WorkerPool, ReportsIdleWorkersBeforeTheySleep) {
  WorkerPool* pool = nullptr;
  std::latch made(1);
  std::atomic<int> idle = 0;
  std::atomic<int> max = 0;
  std::atomic<int> rounds = 0;
  std::promise<void> done;
  const auto listen = [&](bool isIdle) {
    made.wait();
    idle += isIdle ? 1 : -1;
    max = std::max(max.load(), idle.load());
    if (isIdle && rounds < 1000) {
      pool->post([&] {
        EXPECT_LT(idle, 2) << "one of two is at work";
        if (++rounds == 1000) done.set_value();
      });
    }
  };
  {
    WorkerPool two(2, "two", listen);
    pool = &two;
    made.count_down();
    EXPECT_EQ(done.get_future().wait_for(std::chrono::seconds(20)), std::future_status::ready);
  }
  EXPECT_EQ(idle, 0);
  EXPECT_LE(max, 2);
}

}  // namespace
}  // namespace grove::pipeline
