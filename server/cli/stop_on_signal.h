#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <stop_token>
#include <thread>

namespace grove::cli {

/// Turns SIGINT and SIGTERM into a stop request. Create it before all other threads, which inherit its signal mask.
class StopOnSignal {
 public:
  enum class Event { kStop, kHangup, kNone };
  /// Effect of SIGHUP: it ends the process at once, or waitFor() reports it; then it is a stop request only if the
  /// process's terminal is gone.
  enum class Hangup { kEnds, kIsReported };

  explicit StopOnSignal(Hangup hangup = Hangup::kEnds);
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

  /// Waits for a signal, at most for `patience`.
  [[nodiscard]] Event waitFor(std::chrono::milliseconds patience);

  /// From now on a signal ends the process with exit code 0 if it has not ended by itself within `patience`: for work
  /// that reacts slowly and loses nothing when it is cut off.
  void endWithin(std::chrono::milliseconds patience) noexcept { patience_ = patience.count(); }

 private:
  void watch(const std::stop_token& ended);
  void reportHangup();

  const bool hadTerminal_;
  sigset_t signals_{};
  std::mutex mutex_;
  std::condition_variable_any reported_;
  bool hangup_ = false;  ///< a SIGHUP that was not reported yet
  std::stop_source stop_;
  std::atomic<std::chrono::milliseconds::rep> patience_{-1};  ///< negative: none set
  std::jthread watcher_;
};

}  // namespace grove::cli
