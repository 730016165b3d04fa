#pragma once

#include <optional>

#include "stream/load/walk_follower.h"

namespace grove::stream {

/// The controls of one visitor of a load test. One thread.
class Steering {
 public:
  /// `index` makes visitors differ. `plan` outlives this.
  Steering(int index, const LoadPlan& plan, const Welcome& welcome);

  /// Returns the controls at `seconds` after admission. The input has no number yet.
  [[nodiscard]] world::Input at(double seconds);

  /// Returns whether the visitor has reached the begin of the walk.
  [[nodiscard]] bool isInPlace() const { return !follower_ || follower_->isOnWalk(); }

 private:
  const int index_;
  const Movement movement_;
  const float yaw_;
  const float pitch_;
  std::optional<WalkFollower> follower_;
};

}  // namespace grove::stream
