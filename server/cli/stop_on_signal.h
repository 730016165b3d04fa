#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <stop_token>
#include <thread>

namespace grove::cli {

/// Turns SIGINT and SIGTERM into a request to stop. To be made before all other threads, which inherit its mask.
class StopOnSignal {
 public:
  enum class Event { kStop, kHangup, kNone };
  /// What SIGHUP does: ends the process at once, or is reported to who waits; then it is a request to stop only if the
  /// terminal that the process was started from is gone.
  enum class Hangup { kEnds, kIsReported };

  explicit StopOnSignal(Hangup hangup = Hangup::kEnds);
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

  /// Returns when a signal has come, or after so long.
  [[nodiscard]] Event waitFor(std::chrono::milliseconds patience);

  /// From now on a signal ends the process, successfully, if it has not come to its end by itself within so long: for
  /// work that takes its time to notice, and loses nothing when it is cut off.
  void endWithin(std::chrono::milliseconds patience) noexcept { patience_ = patience.count(); }

 private:
  void watch(const std::stop_token& ended);
  void reportHangup();

  const bool hadTerminal_;
  sigset_t signals_{};
  std::mutex mutex_;
  std::condition_variable_any reported_;
  bool hangup_ = false;  ///< one that was not reported yet
  std::stop_source stop_;
  std::atomic<std::chrono::milliseconds::rep> patience_{-1};  ///< negative: none set
  std::jthread watcher_;
};

}  // namespace grove::cli
