#pragma once

#include <csignal>

namespace grove::cli {

/// SIGINT and SIGTERM for a process that must stay without threads (StopOnSignal has one). Restores the signal mask at
/// its end.
class Interruption {
 public:
  /// Throws EnvironmentError.
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Returns true when the descriptor is readable, and false if a signal comes before, or has come already.
  [[nodiscard]] bool awaitReadable(int descriptor);
  [[nodiscard]] bool hasCome() const noexcept { return hasCome_; }
  /// Records a signal that another process of the bench has received: a signal to the group may arrive there first.
  void reportStopped() noexcept { hasCome_ = true; }

 private:
  sigset_t signals_{};
  sigset_t former_{};  ///< mask
  int descriptor_ = -1;
  bool hasCome_ = false;
};

}  // namespace grove::cli
