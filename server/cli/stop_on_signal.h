#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <stop_token>
#include <thread>

namespace grove::cli {

/// Turns SIGINT and SIGTERM into a request to stop. To be made before all other threads, which inherit its mask.
class StopOnSignal {
 public:
  StopOnSignal();
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

  /// Returns when a signal has come.
  void wait() const;

  /// From now on a signal ends the process, successfully, if it has not come to its end by itself within so long: for
  /// work that takes its time to notice, and loses nothing when it is cut off.
  void endWithin(std::chrono::milliseconds patience) noexcept { patience_ = patience.count(); }

 private:
  void watch(const std::stop_token& ended);

  sigset_t signals_{};
  std::stop_source stop_;
  std::atomic<std::chrono::milliseconds::rep> patience_{-1};  ///< negative: none set
  std::jthread watcher_;
};

}  // namespace grove::cli
