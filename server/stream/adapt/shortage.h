#pragma once

#include <array>
#include <cstddef>

#include "stream/protocol/protocol.h"

namespace grove::stream {

/// Measures what delays a visitor's frames: the share of the last seconds in which a due frame could not begin, by
/// cause. Not thread-safe; times are monotonic seconds.
class Shortage {
 public:
  /// `who` delays a due frame. Call again while that lasts.
  void blocked(LimitedBy who, double now);
  /// A frame begins. Returns how long it waited for the server, seconds.
  double began(double now);
  /// No frame is wanted.
  void rest() { isWaiting_ = false; }

  /// 0 to 1.
  [[nodiscard]] double share(LimitedBy who, double now) const;
  /// The main cause of delays, or kNothing if none matters.
  [[nodiscard]] LimitedBy main(double now) const;
  /// Frames that begin a second; 0 before the second frame.
  [[nodiscard]] double framesPerSecond() const noexcept { return period_ > 0.0 ? 1.0 / period_ : 0.0; }

 private:
  static constexpr std::size_t kCount = 5;  ///< values of LimitedBy
  void settle(double now);

  std::array<double, kCount> seconds_{};  ///< delayed, fading
  double settled_ = 0.0;                  ///< seconds_ counts until then
  bool isWaiting_ = false;
  LimitedBy waitsFor_ = LimitedBy::kNothing;
  double waitsForServer_ = 0.0;  ///< of the due frame
  double lastBegan_ = -1.0;
  double period_ = 0.0;
};

}  // namespace grove::stream
