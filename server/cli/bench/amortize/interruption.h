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
  /// A process of this bench was told to stop: a signal to all of them may reach that one first.
  void reportStopped() noexcept { hasCome_ = true; }

 private:
  sigset_t signals_{};
  sigset_t former_{};  ///< mask
  int descriptor_ = -1;
  bool hasCome_ = false;
};

}  // namespace grove::cli
