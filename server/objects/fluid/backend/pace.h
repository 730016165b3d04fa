#pragma once

namespace grove::objects::fluid {

/// Reports whether ticks that must each be done within a period can be: by their mean, since one may wait for another.
/// One thread.
class Pace {
 public:
  /// `period` in seconds.
  explicit Pace(double period) noexcept : max_(kShare * period) {}

  /// Takes what the thread needed for a tick; true if the last kTicks together took too long.
  [[nodiscard]] bool tooSlow(double seconds) noexcept {
    sum_ += seconds;
    if (++ticks_ < kTicks) return false;
    const bool slow = sum_ > max_ * kTicks;
    restart();
    return slow;
  }
  /// For ticks that are of another kind from here on.
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
