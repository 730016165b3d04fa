#pragma once

#include <deque>
#include <optional>

namespace grove::node {

/// Estimates a peer's clock from the times that it reports. Uses the report with the shortest way of the newest 128, so
/// the estimate is behind by that way, and follows a clock that drifts. Ignores a report that differs from the others
/// by more than ten seconds, unless the next one confirms it: then the clock has started again. Times are seconds.
class PeerClock {
 public:
  /// It reported `theirs`, which came when the clock here showed `ours`.
  void addReport(double theirs, double ours);

  /// What it shows while the clock here shows `ours`; nothing if it reported nothing yet.
  [[nodiscard]] std::optional<double> at(double ours) const;

 private:
  /// Some seconds of world updates.
  static constexpr std::size_t kKept = 128;
  /// Seconds, more than a report is under way.
  static constexpr double kJump = 10.0;
  std::deque<double> ahead_;       ///< theirs less ours
  double offset_ = 0.0;            ///< the greatest of them
  std::optional<double> doubted_;  ///< what the last report said, if it jumped
};

}  // namespace grove::node
