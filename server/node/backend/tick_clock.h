#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace grove::node {

/// A thread that ticks at a steady rate until destruction, or sleeps while there are no visitors. After a late tick, at
/// most one tick follows without a pause; further missed ticks are skipped.
class TickClock {
 public:
  /// kSleep: no tick until wake().
  enum class Next { kTick, kSleep };

  /// `tick` runs on the clock's thread and must not throw.
  TickClock(double ticksPerSecond, std::function<Next()> tick);

  /// Waits for the tick in progress and stops.
  ~TickClock();

  TickClock(const TickClock&) = delete;
  TickClock& operator=(const TickClock&) = delete;

  /// Ends the sleep with an immediate tick. Called during a tick, it prevents the sleep after that tick. Any thread;
  /// almost free while the clock is awake.
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

}  // namespace grove::node
