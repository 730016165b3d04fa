#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace grove::objects::fluid {

/// A thread of its own that ticks at a steady rate until it is destroyed, or sleeps while there is nobody to tick for.
/// A tick that comes late is followed by at most one without a pause; what was missed beyond that is skipped.
class FluidClock {
 public:
  /// Whether there is more to do: after kSleep no tick comes until wake().
  enum class Next { kTick, kSleep };

  /// `tick` runs on the clock's thread and must not throw.
  FluidClock(double ticksPerSecond, std::function<Next()> tick);

  /// Stops after the tick in progress.
  ~FluidClock();

  FluidClock(const FluidClock&) = delete;
  FluidClock& operator=(const FluidClock&) = delete;

  /// Ends the sleep with a tick at once. Called during a tick, it keeps the clock from falling asleep after it. Any
  /// thread; costs next to nothing while the clock is awake.
  void wake();

 private:
  void run(double ticksPerSecond);

  const std::function<Next()> tick_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  bool wanted_ = false;  ///< wake() was called since the newest tick began
  bool asleep_ = false;
  std::thread thread_;
};

}  // namespace grove::objects::fluid
