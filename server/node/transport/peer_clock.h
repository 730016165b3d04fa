#pragma once

#include <deque>
#include <optional>

namespace grove::node {

/// Estimates a peer's clock from the times that it reports. Uses the report with the smallest delay of the newest 128,
/// so the estimate is late by that delay, and follows a drifting clock. Ignores a report that differs from the others
/// by more than ten seconds, unless the next one confirms it: then the clock has restarted. Times are seconds.
class PeerClock {
 public:
  /// Adds a report: the peer's clock showed `theirs` when this process's showed `ours`.
  void addReport(double theirs, double ours);

  /// The peer's clock when this process's shows `ours`; empty before the first report.
  [[nodiscard]] std::optional<double> at(double ours) const;

 private:
  /// Some seconds of world updates.
  static constexpr std::size_t kKept = 128;
  /// Seconds; longer than any delay of a report.
  static constexpr double kJump = 10.0;
  std::deque<double> ahead_;       ///< `theirs` minus `ours`
  double offset_ = 0.0;            ///< the maximum of them
  std::optional<double> doubted_;  ///< the last report, if it jumped
};

}  // namespace grove::node
