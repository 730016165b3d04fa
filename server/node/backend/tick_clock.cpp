#include "node/backend/tick_clock.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace grove::node {

TickClock::TickClock(double ticksPerSecond, std::function<Next()> tick)
    : tick_(std::move(tick)), thread_([this, ticksPerSecond] { run(ticksPerSecond); }) {}

TickClock::~TickClock() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void TickClock::wake() {
  const std::lock_guard lock(mutex_);
  wanted_ = true;
  if (asleep_) wake_.notify_all();
}

void TickClock::run(double ticksPerSecond) {
  using Clock = std::chrono::steady_clock;
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / ticksPerSecond));
  Clock::time_point due = Clock::now();
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    wanted_ = false;
    lock.unlock();
    const Next next = tick_();
    due = std::max(due + period, Clock::now() - period);
    lock.lock();
    if (next == Next::kTick || wanted_) {
      wake_.wait_until(lock, due, [this] { return stopping_; });
    } else {
      asleep_ = true;
      wake_.wait(lock, [this] { return stopping_ || wanted_; });
      asleep_ = false;
      due = Clock::now();
    }
  }
}

}  // namespace grove::node
