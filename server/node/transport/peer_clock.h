#pragma once

#include <deque>
#include <optional>

namespace grove::node {

/// What the clock of a peer shows, known from the times that it reports: of the newest ones that counts which was under
/// way for the shortest time. So it is behind by that, and follows a clock that drifts. A report that is far from all
/// others counts only if the next one is like it, for then the clock began anew. Times are seconds.
class PeerClock {
 public:
  /// It reported `theirs`, which came when the clock here showed `ours`.
  void hear(double theirs, double ours);

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
