#include "objects/fluid/fluid_clock.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace grove::objects::fluid {

FluidClock::FluidClock(double ticksPerSecond, std::function<void()> tick)
    : tick_(std::move(tick)), thread_([this, ticksPerSecond] { run(ticksPerSecond); }) {}

FluidClock::~FluidClock() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void FluidClock::run(double ticksPerSecond) {
  using Clock = std::chrono::steady_clock;
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / ticksPerSecond));
  Clock::time_point due = Clock::now();
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    tick_();
    due = std::max(due + period, Clock::now() - period);
    lock.lock();
    wake_.wait_until(lock, due, [this] { return stopping_; });
  }
}

}  // namespace grove::objects::fluid
