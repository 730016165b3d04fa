#pragma once

#include <grpcpp/alarm.h>

#include <functional>
#include <memory>
#include <random>

namespace grove::node {

/// Exponential backoff: makes calls after pauses that double from 0.1 s to 1 s, with jitter, so that many links do not
/// return at the same time. One thread at a time.
class RetryTimer {
 public:
  static constexpr int kFirstMilliseconds = 100;
  static constexpr int kLongestMilliseconds = 1000;

  /// Calls `retry` after the next pause, on one of gRPC's threads, instead of an earlier `retry` that has not begun.
  void set(std::function<void()> retry);
  /// Cancels a `retry` that has not begun.
  void cancel() { alarm_.reset(); }

  /// Makes the next pause the shortest.
  void reset() noexcept { pauseMilliseconds_ = kFirstMilliseconds; }
  /// Makes the next pause the longest.
  void slowDown() noexcept { pauseMilliseconds_ = kLongestMilliseconds; }

 private:
  int pauseMilliseconds_ = kFirstMilliseconds;
  std::minstd_rand random_{std::random_device{}()};
  std::unique_ptr<grpc::Alarm> alarm_;
};

}  // namespace grove::node
