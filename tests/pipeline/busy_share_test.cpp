#include "pipeline/busy_share.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "pipeline/worker_pool.h"

namespace grove::pipeline {
namespace {

TEST(BusyShare, ApproachesTheShareOfBusyWorkers) {
  BusyShare share(4);
  EXPECT_EQ(share.at(7.0), 0.0);
  share.begin(10.0);
  share.begin(10.0);
  EXPECT_NEAR(share.at(10.0), 0.0, 1e-12);
  EXPECT_NEAR(share.at(10.0 + BusyShare::kSeconds), 0.5 * (1.0 - std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(share.at(100.0), 0.5, 1e-12);
  share.end(100.0);
  share.end(100.0);
  EXPECT_NEAR(share.at(100.0 + BusyShare::kSeconds), 0.5 * std::exp(-1.0), 1e-12);
}

/// Fails if it depends on how work is cut into tasks.
TEST(BusyShare, AlternatingWorkerIsHalfBusy) {
  BusyShare share(1);
  for (int i = 0; i < 10000; ++i) {
    share.begin(1e-3 * i);
    share.end(1e-3 * i + 0.5e-3);
  }
  EXPECT_NEAR(share.at(10.0), 0.5, 2e-3);
}

TEST(BusyShare, PoolEqualsItsThreads) {
  WorkerPool pool(2, "pool", {}, WorkerPool::kMeasured);
  EXPECT_EQ(pool.busyShare(), 0.0);
  const double least = 0.25;
  std::atomic<bool> enough = false;
  pool.post([&] {
    while (!enough) std::this_thread::yield();
  });
  while (pool.busyShare() < least) std::this_thread::yield();
  EXPECT_LE(pool.busyShare(), 0.5) << "one of two";
  enough = true;
  pool.drain();
  while (pool.busyShare() >= least) std::this_thread::yield();
}

}  // namespace
}  // namespace grove::pipeline
