#pragma once

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

 private:
  sigset_t signals_{};
  std::stop_source stop_;
  std::jthread watcher_;
};

}  // namespace grove::cli
