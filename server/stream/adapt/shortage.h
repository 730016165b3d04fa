#pragma once

#include <array>
#include <cstddef>

#include "stream/protocol/protocol.h"

namespace grove::stream {

/// Measures who keeps a visitor's frames back: the share of the last seconds in which a frame was due and could not
/// begin, by who was not ready for it. One thread at a time; times are seconds that do not go back.
class Shortage {
 public:
  /// A frame is due and may not begin because of `who`; to be called again while that lasts.
  void blocked(LimitedBy who, double now);
  /// A frame begins. Returns how long it waited for the server, seconds.
  double began(double now);
  /// No frame is wanted.
  void rest() { isWaiting_ = false; }

  /// 0 to 1.
  [[nodiscard]] double share(LimitedBy who, double now) const;
  /// Who keeps frames back most, or nothing if nobody does for a share that matters.
  [[nodiscard]] LimitedBy main(double now) const;
  /// Frames that begin a second; 0 until two have.
  [[nodiscard]] double framesPerSecond() const noexcept { return period_ > 0.0 ? 1.0 / period_ : 0.0; }

 private:
  static constexpr std::size_t kCount = 5;  ///< values of LimitedBy
  void settle(double now);

  std::array<double, kCount> seconds_{};  ///< blocked, fading
  double settled_ = 0.0;                  ///< until when seconds_ counts
  bool isWaiting_ = false;
  LimitedBy waitsFor_ = LimitedBy::kNothing;
  double waitsForServer_ = 0.0;  ///< the frame that is due
  double lastBegan_ = -1.0;
  double period_ = 0.0;
};

}  // namespace grove::stream
