#pragma once

#include "world/players.h"

namespace grove::stream {

/// Predicts a turn of the head. One thread at a time.
class TurnLead {
 public:
  /// Returns the turn in `seconds` from now if it goes on at the slower of the last two rates: heads begin and end
  /// turns abruptly. `angle` in radians; `sinceLast`: seconds since the last call.
  [[nodiscard]] float turnAhead(float angle, double sinceLast, double seconds);

 private:
  float last_ = 0.0F;
  double rate_ = 0.0;  ///< radians per second
};

/// Predicts from where a visitor will see the picture that is drawn now, for pages that move and turn it for the rest
/// of the way (late look, late walk). While keys and turn go on, the page has little to move, so hardly anything is
/// missing in what it shows. One visitor's; one thread at a time.
class CameraLead {
 public:
  /// Returns the visitor's pose in `seconds` from `now` if they keep their keys and go on turning. Call it once a
  /// frame.
  [[nodiscard]] world::Pose poseAhead(const world::Players& players, const world::Player& visitor, double seconds,
                                      double now);

 private:
  double lastTime_ = 0.0;
  TurnLead yaw_;
  TurnLead pitch_;
};

}  // namespace grove::stream
