#pragma once

#include "stream/load/load_plan.h"

namespace grove::stream {

/// Steers a visitor along a walk by keys. The server does not report positions, so the follower computes its position
/// from its own keys by the laws of world::Players, looks where the walk looks, and holds the keys that bring it
/// nearest to the walk's next position. It first runs straight to the begin of the walk, then follows the walk back and
/// forth without end. Obstacles, and a line that delays keys or delivers them in bursts, leave the visitor beside the
/// walk. Not thread-safe.
class WalkFollower {
 public:
  /// `arrived` is the eye's first position; the walk begins at `offset` seconds. `plan` outlives this.
  WalkFollower(const WalkToFollow& plan, world::Vec3 arrived, double offset);

  /// Returns the controls at `seconds` after arrival, which never decreases. The input has no number yet.
  [[nodiscard]] world::Input steer(double seconds);

  /// Returns whether the visitor has reached the begin of the walk.
  [[nodiscard]] bool isOnWalk() const noexcept { return beganAt_ >= 0.0; }
  /// The computed position.
  [[nodiscard]] world::Vec3 position() const noexcept { return position_; }

 private:
  void advance(double seconds);
  [[nodiscard]] world::Input approach(const world::Pose& start) const;
  [[nodiscard]] std::uint8_t keysTowards(world::Vec3 place, float yaw, float seconds) const;

  const WalkToFollow& plan_;
  const double offset_;
  world::Vec3 position_;
  world::Vec3 velocity_{0.0F};
  world::Input held_;
  double time_ = 0.0;
  double beganAt_ = -1.0;  ///< negative: not yet
};

}  // namespace grove::stream
