#pragma once

namespace grove::stream {

/// Chooses how much more than its window a page gets of each picture, for late look: more over longer lines. Each
/// change begins with an independent picture, so changes need hysteresis. Not thread-safe.
class BorderChoice {
 public:
  /// The widest border, percent of half the window.
  static constexpr int kMaxPercent = 12;

  /// `hasRoom`: the page wants a border, and nothing limits the stream. `roundTrip`: of the idle line, seconds.
  void update(bool hasRoom, double roundTrip);
  [[nodiscard]] int percent() const noexcept { return steps_ * kMaxPercent / kSteps; }

 private:
  static constexpr int kSteps = 2;
  int steps_ = 0;
};

}  // namespace grove::stream
