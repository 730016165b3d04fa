#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "objects/fluid/backend/scalable_fire.h"
#include "sanitized.h"

namespace grove::objects::fluid {
namespace {

using ScalableSimulationThreadsTest = ScalableFire;

TEST_F(ScalableSimulationThreadsTest, NewestRequestWins) {
  auto simulation = scalable(16);
  run(simulation.current(), 5);
  simulation.setCells(64);
  EXPECT_FALSE(simulation.update());
  simulation.setCells(24);
  while (!simulation.update()) run(simulation.current(), 1);
  EXPECT_EQ(simulation.current().solver().layout().cells, 24);

  // Back to where it is: nothing changes.
  simulation.setCells(64);
  EXPECT_FALSE(simulation.update());
  simulation.setCells(24);
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(simulation.update());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(simulation.current().solver().layout().cells, 24);
}

TEST_F(ScalableSimulationThreadsTest, ConcurrentRequests) {
  auto simulation = scalable(16);
  std::atomic<bool> done = false;
  std::vector<std::thread> visitors;
  visitors.reserve(3);
  for (int i = 0; i < 3; ++i) {
    visitors.emplace_back([&, i] {
      for (int k = i; !done; ++k) {
        simulation.setCells(cellsAt(16, k % 3));
        std::this_thread::sleep_for(std::chrono::milliseconds(1 + i));
      }
    });
  }
  int changes = 0;
  for (int i = 0; i < (kSanitized ? 60 : 300) || changes < 5; ++i) {
    changes += simulation.update() ? 1 : 0;
    run(simulation.current(), 1);
    ASSERT_EQ(simulation.current().tick(), static_cast<std::uint64_t>(i + 1));
    ASSERT_LE(simulation.current().result().residual, 1.0e-4F);
  }
  done = true;
  for (std::thread& each : visitors) each.join();
}

}  // namespace
}  // namespace grove::objects::fluid
