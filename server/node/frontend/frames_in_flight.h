#pragma once

#include <functional>
#include <mutex>

namespace grove::node {

/// Counts the frames of one visitor that are being made, so that each that began ends once, be it shown, dropped, or
/// cut off by the end of its frontend node. Any thread.
class FramesInFlight {
 public:
  /// `ended` is called for each frame that ends, without a lock held; may be empty.
  FramesInFlight(int max, std::function<void()> ended);

  /// False if `max` are being made, or after close().
  [[nodiscard]] bool begin();
  void end();
  /// Takes a begin() back, without a call of `ended`; false if close() has ended that frame already.
  [[nodiscard]] bool cancel();
  /// Ends all; those that were under way do not end a second time.
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
