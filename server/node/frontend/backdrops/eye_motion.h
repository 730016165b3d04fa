#pragma once

#include "world/camera.h"

namespace grove::node {

/// Motion and rotation of a visitor's eye, estimated from the last frames. One thread at a time.
class EyeMotion {
 public:
  /// Adds a frame's camera at `time`, seconds of the world's clock.
  void see(const world::Camera& camera, double time);

  /// Whether the newest frame has the same eye as the one before.
  [[nodiscard]] bool isAtRest() const noexcept { return isAtRest_; }

  [[nodiscard]] float secondsPerFrame() const noexcept { return secondsPerFrame_; }

  /// Metres a second.
  [[nodiscard]] world::Vec3 velocity() const noexcept { return velocity_; }

  /// Predicts the camera after some seconds.
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
