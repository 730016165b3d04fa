#include "objects/fluid/backend/fluid_clock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace grove::objects::fluid {
namespace {

using Next = FluidClock::Next;

constexpr auto kAWhile = std::chrono::milliseconds(20);

TEST(FluidClock, TicksUntilItIsDestroyed) {
  std::atomic<int> ticks = 0;
  {
    const FluidClock clock(1000.0, [&] {
      ++ticks;
      return Next::kTick;
    });
    while (ticks < 5) std::this_thread::yield();
  }
  const int stopped = ticks;
  std::this_thread::sleep_for(kAWhile);
  EXPECT_EQ(ticks, stopped);
}

TEST(FluidClock, StopsWhileItWaits) {
  std::atomic<int> ticks = 0;
  {
    const FluidClock clock(0.001, [&] {
      ++ticks;
      return Next::kTick;
    });
    while (ticks < 1) std::this_thread::yield();
  }
  EXPECT_EQ(ticks, 1);
}

TEST(FluidClock, WakesWithoutCatchingUp) {
  std::atomic<int> ticks = 0;
  FluidClock clock(1000.0, [&] {
    ++ticks;
    return Next::kSleep;
  });
  for (int woken = 1; woken <= 5; ++woken) {
    while (ticks < woken) std::this_thread::yield();
    std::this_thread::sleep_for(kAWhile);
    EXPECT_EQ(ticks, woken) << "what was slept through is not caught up";
    clock.wake();
  }
  while (ticks < 6) std::this_thread::yield();
}

TEST(FluidClock, KeepsWakeUpsDuringATick) {
  std::atomic<int> ticks = 0;
  std::atomic<bool> woken = false;
  FluidClock clock(1000.0, [&] {
    if (++ticks == 1) {
      while (!woken) std::this_thread::yield();
    }
    return Next::kSleep;
  });
  while (ticks < 1) std::this_thread::yield();
  clock.wake();
  woken = true;
  while (ticks < 2) std::this_thread::yield();
}

}  // namespace
}  // namespace grove::objects::fluid
