#pragma once

#include <algorithm>
#include <chrono>

namespace grove::tests {

/// Time that passes while this process runs. Who stops it, or the machine below it, for a minute has not made it wait
/// for a minute: a deadline of this time stays fair. Look at it often. One thread.
class RunningTime {
 public:
  using Clock = std::chrono::steady_clock;

  /// Since this was made. Between two looks at most kMaxStep counts.
  Clock::duration passed() {
    const Clock::time_point now = Clock::now();
    const Clock::duration step = now - last_;
    last_ = now;
    longest_ = std::max(longest_, step);
    passed_ += std::min<Clock::duration>(step, kMaxStep);
    return passed_;
  }
  /// Between two looks so far.
  [[nodiscard]] std::chrono::milliseconds longestStep() const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(longest_);
  }

 private:
  /// More than a frame takes that waits for all its objects.
  static constexpr std::chrono::seconds kMaxStep{1};
  Clock::time_point last_ = Clock::now();
  Clock::duration passed_{0};
  Clock::duration longest_{0};
};

}  // namespace grove::tests
