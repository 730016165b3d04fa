#include "objects/fluid/fluid_clock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace grove::objects::fluid {
namespace {

TEST(FluidClock, TicksUntilItIsDestroyed) {
  std::atomic<int> ticks = 0;
  {
    const FluidClock clock(1000.0, [&] { ++ticks; });
    while (ticks < 5) std::this_thread::yield();
  }
  const int stopped = ticks;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(ticks, stopped);
}

TEST(FluidClock, StopsWhileItWaits) {
  std::atomic<int> ticks = 0;
  {
    const FluidClock clock(0.001, [&] { ++ticks; });
    while (ticks < 1) std::this_thread::yield();
  }
  EXPECT_EQ(ticks, 1);
}

}  // namespace
}  // namespace grove::objects::fluid
