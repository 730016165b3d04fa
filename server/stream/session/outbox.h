#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "stream/encode/encoded_frame.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {

/// Messages that wait to be sent to one visitor: the newest independent frame with those after it that depend on it,
/// and the newest status, times and capture. At most as many frames
/// wait as may be in flight, so a slow visitor holds little memory and never sees old frames. Thread-safe.
class Outbox {
 public:
  /// Calls `wake` on the putting thread when there is something to send; it must not block.
  explicit Outbox(std::function<void()> wake) : wake_(std::move(wake)) {}

  void put(std::shared_ptr<const EncodedFrame> frame) {
    std::deque<std::shared_ptr<const EncodedFrame>> outdated;
    {
      const std::lock_guard lock(mutex_);
      if (frame->header.independent) frames_.swap(outdated);
      frames_.push_back(std::move(frame));
    }
    wake_();
  }

  void put(const Status& status) { replace(status_, status); }
  void put(const Times& times) { replace(times_, times); }
  /// A Captured message.
  void putCaptured(std::vector<std::uint8_t> message) { replace(captured_, std::move(message)); }

  [[nodiscard]] std::optional<Status> takeStatus() {
    const std::lock_guard lock(mutex_);
    return std::exchange(status_, std::nullopt);
  }

  [[nodiscard]] std::optional<Times> takeTimes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(times_, std::nullopt);
  }

  [[nodiscard]] std::optional<std::vector<std::uint8_t>> takeCaptured() {
    const std::lock_guard lock(mutex_);
    return std::exchange(captured_, std::nullopt);
  }

  [[nodiscard]] bool hasFrame() const {
    const std::lock_guard lock(mutex_);
    return !frames_.empty();
  }

  /// The frame to send next, or null.
  [[nodiscard]] std::shared_ptr<const EncodedFrame> take() {
    const std::lock_guard lock(mutex_);
    if (frames_.empty()) return nullptr;
    auto next = std::move(frames_.front());
    frames_.pop_front();
    return next;
  }

  [[nodiscard]] bool empty() const {
    const std::lock_guard lock(mutex_);
    return frames_.empty() && !status_ && !times_ && !captured_;
  }

 private:
  template <class Message>
  void replace(std::optional<Message>& slot, Message message) {
    {
      const std::lock_guard lock(mutex_);
      slot = std::move(message);
    }
    wake_();
  }

  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<const EncodedFrame>> frames_;
  std::optional<Status> status_;
  std::optional<Times> times_;
  std::optional<std::vector<std::uint8_t>> captured_;
};

}  // namespace grove::stream
