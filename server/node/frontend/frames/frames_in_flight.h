#pragma once

#include <functional>
#include <mutex>

namespace grove::node {

/// Counts the frames of one visitor in progress, so that each frame ends exactly once: shown, dropped, or stopped by
/// the end of its frontend node. Thread-safe.
class FramesInFlight {
 public:
  /// Calls `ended`, which may be empty, for each frame that ends, without a lock held.
  FramesInFlight(int max, std::function<void()> ended);

  /// Returns false if `max` frames are in progress, or after close().
  [[nodiscard]] bool begin();
  void end();
  /// Reverts a begin() without a call of `ended`; returns false if close() has already ended that frame.
  [[nodiscard]] bool cancel();
  /// Ends all frames; those in progress do not end a second time.
  void close();
  [[nodiscard]] int count() const;
  [[nodiscard]] bool full() const { return count() >= max_; }

 private:
  const int max_;
  const std::function<void()> ended_;
  mutable std::mutex mutex_;
  int count_ = 0;
  bool closed_ = false;
};

}  // namespace grove::node
