#include "node/backend/tick_clock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace grove::node {
namespace {

using Next = TickClock::Next;

constexpr auto kAWhile = std::chrono::milliseconds(20);

TEST(TickClock, TicksUntilItIsDestroyed) {
  std::atomic<int> ticks = 0;
  {
    const TickClock clock(1000.0, [&] {
      ++ticks;
      return Next::kTick;
    });
    while (ticks < 5) std::this_thread::yield();
  }
  const int stopped = ticks;
  std::this_thread::sleep_for(kAWhile);
  EXPECT_EQ(ticks, stopped);
}

TEST(TickClock, StopsWhileItWaits) {
  std::atomic<int> ticks = 0;
  {
    const TickClock clock(0.001, [&] {
      ++ticks;
      return Next::kTick;
    });
    while (ticks < 1) std::this_thread::yield();
  }
  EXPECT_EQ(ticks, 1);
}

TEST(TickClock, WakesWithoutCatchingUp) {
  std::atomic<int> ticks = 0;
  TickClock clock(1000.0, [&] {
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

TEST(TickClock, KeepsWakeUpsDuringATick) {
  std::atomic<int> ticks = 0;
  std::atomic<bool> woken = false;
  TickClock clock(1000.0, [&] {
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
}  // namespace grove::node
