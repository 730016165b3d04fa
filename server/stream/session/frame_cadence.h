#pragma once

#include <algorithm>
#include <optional>

namespace grove::stream {

/// When a session's next frame is due. Frames that begin late are made up for, so that a visitor gets the wanted frame
/// rate on average although some frames take longer than a period. Times in seconds of any one clock. Not thread-safe.
class FrameCadence {
 public:
  /// Maximum number of frames that are made up for.
  static constexpr double kMaxMissed = 8.0;
  /// Minimum interval between two frames, in periods: a page shows at most 60 frames per second.
  static constexpr double kMinInterval = 0.5;

  [[nodiscard]] double due() const noexcept { return due_; }

  /// A frame begins; `period` is the wanted interval.
  void begins(double now, double period) noexcept {
    planned_ = planned_ ? std::max(*planned_ + period, now - kMaxMissed * period) : now + period;
    due_ = std::max(*planned_, now + kMinInterval * period);
  }

 private:
  std::optional<double> planned_;  ///< the next frame's time if none had been late; empty before the first
  double due_ = 0.0;
};

}  // namespace grove::stream
