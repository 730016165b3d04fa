#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "stream/encoder.h"
#include "stream/protocol.h"

namespace grove::stream {

/// What waits to be sent to one visitor: at most one frame, the newest, and before the first one how long it takes, the
/// newest, too. So a slow visitor holds one frame in memory and never sees old ones. Any thread.
class Outbox {
 public:
  /// `wake` is called, on the thread that puts, when there is something to send; it must not block.
  explicit Outbox(std::function<void()> wake) : wake_(std::move(wake)) {}

  void put(std::shared_ptr<const EncodedFrame> frame) {
    {
      const std::lock_guard lock(mutex_);
      frame_.swap(frame);
    }
    wake_();
  }

  void put(const Waiting& waiting) {
    {
      const std::lock_guard lock(mutex_);
      waiting_ = waiting;
    }
    wake_();
  }

  /// To send before any frame.
  [[nodiscard]] std::optional<Waiting> takeWaiting() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, std::nullopt);
  }

  /// The frame to send next, or null.
  [[nodiscard]] std::shared_ptr<const EncodedFrame> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(frame_, nullptr);
  }

  [[nodiscard]] bool empty() const {
    const std::lock_guard lock(mutex_);
    return frame_ == nullptr && !waiting_;
  }

 private:
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::shared_ptr<const EncodedFrame> frame_;
  std::optional<Waiting> waiting_;
};

}  // namespace grove::stream
