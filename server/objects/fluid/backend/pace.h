#pragma once

#include <optional>

namespace grove::objects::fluid {

/// Detects ticks that take longer than their period. Compares the mean of kTicks ticks, since a tick may wait for
/// another one. One thread.
class Pace {
 public:
  /// `period` in seconds.
  explicit Pace(double period) noexcept : max_(kShare * period) {}

  /// Adds the time of one tick; after every kTicks, returns the mean of their times if it is too long.
  [[nodiscard]] std::optional<double> slowMean(double seconds) noexcept {
    sum_ += seconds;
    if (++ticks_ < kTicks) return std::nullopt;
    const double mean = sum_ / kTicks;
    restart();
    return mean > max_ ? std::optional(mean) : std::nullopt;
  }
  /// Call this when the cost of a tick changes.
  void restart() noexcept {
    sum_ = 0.0;
    ticks_ = 0;
  }

  static constexpr int kTicks = 30;
  static constexpr double kShare = 0.95;  ///< of the period

 private:
  const double max_;
  double sum_ = 0.0;
  int ticks_ = 0;
};

}  // namespace grove::objects::fluid
