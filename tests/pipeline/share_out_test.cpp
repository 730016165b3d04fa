#include "pipeline/share_out.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "pipeline/worker_pool.h"

namespace grove::pipeline {
namespace {

TEST(ShareOut, RunsEachPartOnce) {
  WorkerPool pool(3);
  for (const std::size_t parts : {0U, 1U, 2U, 100U}) {
    std::vector<std::atomic<int>> done(parts);
    shareOut(pool, parts, [&](const NextPart& next) {
      while (const auto part = next()) ++done[*part];
    });
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
  }
}

TEST(ShareOut, HelpersTakePartsWhileTheCallerDoes) {
  WorkerPool pool(2);
  std::latch both(2);
  std::mutex mutex;
  std::set<std::thread::id> threads;
  shareOut(pool, 2, [&](const NextPart& next) {
    while (next()) {
      both.arrive_and_wait();
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    }
  });
  EXPECT_EQ(threads.size(), 2U);
}

/// Fails if it waits for helpers that have not begun: all of them wait here themselves.
TEST(ShareOut, CompletesWithoutFreeHelpers) {
  WorkerPool pool(2);
  std::latch all(2);
  std::atomic<int> done = 0;
  for (int caller = 0; caller < 2; ++caller) {
    pool.post([&] {
      all.arrive_and_wait();
      shareOut(pool, 10, [&](const NextPart& next) {
        while (next()) ++done;
      });
    });
  }
  pool.drain();
  EXPECT_EQ(done, 20);
}

/// Those that begin late must not touch what is gone by then.
TEST(ShareOut, LateHelpersDoNothing) {
  WorkerPool pool(2);
  for (int round = 0; round < 2000; ++round) {
    const auto work = std::make_unique<std::function<void(const NextPart&)>>([](const NextPart& next) {
      while (next()) continue;
    });
    shareOut(pool, 3, *work);
  }
}

TEST(ShareOut, ExceptionStopsAfterStartedParts) {
  WorkerPool pool(2);
  std::atomic<int> done = 0;
  const auto run = [&] {
    shareOut(pool, 1000, [&](const NextPart& next) {
      while (const auto part = next()) {
        if (*part == 3) throw std::runtime_error("part 3");
        ++done;
      }
    });
  };
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_LT(done, 1000);
}

}  // namespace
}  // namespace grove::pipeline
