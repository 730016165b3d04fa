#pragma once

#include <cassert>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "pipeline/turns.h"

namespace grove::pipeline {

/// The behaviour of a full queue.
enum class Overflow {
  kReject,      ///< the new value is refused; the producer decides
  kDropOldest,  ///< newest wins: the oldest value is dropped
};

enum class PushResult { kAccepted, kDroppedOldest, kRejected, kClosed };

/// A type whose values wait in several lines, see Turns.
template <class T>
concept HasLines = requires(const T& value) {
  lineOf(value);
};

/// Bounded first-in-first-out list between threads, the arrow of Figure 4.2; values that have lines are served line by
/// line, in turn. Never blocks: a producer that must not lose values reserves room first, and is notified when there is
/// room again.
template <class T>
class Queue {
 public:
  Queue(std::size_t capacity, Overflow overflow) : capacity_(capacity), overflow_(overflow) { assert(capacity > 0); }

  /// Adds a value without a reservation, by the overflow policy.
  PushResult push(T value) {
    const std::lock_guard lock(mutex_);
    if (closed_) return PushResult::kClosed;
    if (hasRoom(value)) {
      values_.push_back(std::move(value));
      return PushResult::kAccepted;
    }
    if (overflow_ == Overflow::kReject || values_.empty()) return PushResult::kRejected;
    values_.pop_front();
    values_.push_back(std::move(value));
    return PushResult::kDroppedOldest;
  }

  /// Reserves one place. If there is none, `onRoom` (may be empty) is called once, on the thread that makes room. A
  /// closed queue grants every reservation and drops pushed values, so that producers can finish.
  bool tryReserve(std::function<void()> onRoom) {
    const std::lock_guard lock(mutex_);
    if (!closed_ && overflow_ == Overflow::kReject && values_.size() + reserved_ >= capacity_) {
      if (onRoom) waiting_.push_back(std::move(onRoom));
      return false;
    }
    if (!closed_ && overflow_ == Overflow::kReject) ++reserved_;
    return true;
  }

  /// Releases a reserved place.
  void cancelReservation() { notify(releaseOne()); }

  /// Adds a value to a reserved place.
  PushResult pushReserved(T value) {
    {
      const std::lock_guard lock(mutex_);
      if (closed_) return PushResult::kClosed;
      if (overflow_ == Overflow::kReject) {
        assert(reserved_ > 0);
        --reserved_;
        values_.push_back(std::move(value));
        return PushResult::kAccepted;
      }
    }
    return push(std::move(value));
  }

  std::optional<T> pop() {
    std::optional<T> value;
    std::vector<std::function<void()>> wake;
    {
      const std::lock_guard lock(mutex_);
      if (values_.empty()) return std::nullopt;
      value.emplace(std::move(values_.front()));
      values_.pop_front();
      wake.swap(waiting_);
    }
    notify(wake);
    return value;
  }

  /// Refuses all further values and drops the queued ones.
  void close() {
    Values dropped;
    std::vector<std::function<void()>> wake;
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
      reserved_ = 0;
      dropped.swap(values_);
      wake.swap(waiting_);
    }
    notify(wake);
  }

  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return values_.size();
  }
  [[nodiscard]] bool closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }
  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }

 private:
  using Values = std::conditional_t<HasLines<T>, Turns<T>, std::deque<T>>;

  [[nodiscard]] bool hasRoom(const T& value) const {
    if constexpr (HasLines<T>) {
      if (!values_.admits(value, capacity_)) return false;
    }
    return values_.size() + reserved_ < capacity_;
  }

  std::vector<std::function<void()>> releaseOne() {
    const std::lock_guard lock(mutex_);
    if (reserved_ == 0) return {};
    --reserved_;
    return std::exchange(waiting_, {});
  }

  static void notify(const std::vector<std::function<void()>>& wake) {
    for (const auto& call : wake) call();
  }

  const std::size_t capacity_;
  const Overflow overflow_;
  mutable std::mutex mutex_;
  Values values_;
  std::size_t reserved_ = 0;
  bool closed_ = false;
  std::vector<std::function<void()>> waiting_;
};

}  // namespace grove::pipeline
