#pragma once

#include "stream/load/load_plan.h"

namespace grove::stream {

/// Leads a visitor along a walk by his keys. Where he is, nobody reports: he reckons it from his own keys by the laws
/// of world::Players, looks where the walk looks, and holds the keys that bring him nearest to where it will be. First
/// he runs from where he arrived to where it begins, straight on; then he goes there and back again, for ever. Whatever
/// stops him on his way, and a line that delivers his keys late and at once, leave him beside it. One thread.
class WalkFollower {
 public:
  /// `arrived` is where his eye is at first; he begins `offset` seconds into the walk. `plan` outlives this.
  WalkFollower(const WalkToFollow& plan, world::Vec3 arrived, double offset);

  /// The controls, so many seconds after he arrived; never back in time. The input has no number yet.
  [[nodiscard]] world::Input steer(double seconds);

  /// Whether he has come to where the walk begins.
  [[nodiscard]] bool isOnWalk() const noexcept { return beganAt_ >= 0.0; }
  /// Where he reckons to be.
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
