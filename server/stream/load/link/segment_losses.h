#pragma once

#include <cstdint>

namespace grove::stream {

/// Draws which segments of a direction are lost, each for itself: the losses of a radio link, which do not come from a
/// full queue. The same seed draws the same losses. Not thread-safe.
class SegmentLosses {
 public:
  /// A segment that is lost more often would break the connection before anything here is measured.
  static constexpr int kMaxTimes = 8;

  /// `share`: of all segments, 0 to 0.2.
  SegmentLosses(double share, std::uint64_t seed);

  /// Returns how often the next segment is lost before it gets through: 0 to kMaxTimes.
  [[nodiscard]] int next() noexcept;

 private:
  double share_;
  std::uint64_t state_;
};

}  // namespace grove::stream
