#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace grove::objects::fluid {

/// A thread of its own that ticks at a steady rate until it is destroyed. A tick that comes late is followed by at most
/// one without a pause; what was missed beyond that is skipped.
class FluidClock {
 public:
  /// `tick` runs on the clock's thread and must not throw.
  FluidClock(double ticksPerSecond, std::function<void()> tick);

  /// Stops after the tick in progress.
  ~FluidClock();

  FluidClock(const FluidClock&) = delete;
  FluidClock& operator=(const FluidClock&) = delete;

 private:
  void run(double ticksPerSecond);

  const std::function<void()> tick_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace grove::objects::fluid
