#pragma once

#include "world/camera.h"

namespace grove::node {

/// How a visitor's eye moves and turns, estimated from his last frames. One thread at a time.
class EyeMotion {
 public:
  /// A frame is seen from here at `time`, seconds of the world's clock.
  void see(const world::Camera& camera, double time);

  /// Whether the newest frame is seen from where the one before was.
  [[nodiscard]] bool isAtRest() const noexcept { return isAtRest_; }

  [[nodiscard]] float secondsPerFrame() const noexcept { return secondsPerFrame_; }

  /// Metres a second.
  [[nodiscard]] world::Vec3 velocity() const noexcept { return velocity_; }

  /// Where the camera is after some seconds.
  [[nodiscard]] world::Camera ahead(world::Camera camera, float seconds) const;

 private:
  world::Pose last_;
  double time_ = -1.0;
  float secondsPerFrame_ = 1.0F / 30.0F;
  world::Vec3 velocity_{0.0F};
  float yawRate_ = 0.0F;  ///< radians a second
  float pitchRate_ = 0.0F;
  bool isAtRest_ = false;
};

}  // namespace grove::node
