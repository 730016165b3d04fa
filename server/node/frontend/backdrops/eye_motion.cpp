#include "node/frontend/backdrops/eye_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grove::node {
namespace {

/// Seconds. Frames farther apart do not predict each other.
constexpr double kPause = 0.5;
/// Metres a second; faster is a teleport.
constexpr float kFastest = 20.0F;
/// Weight of the newest frame in the running means.
constexpr float kNewest = 0.5F;

}  // namespace

void EyeMotion::see(const world::Camera& camera, double time) {
  const double passed = time - time_;
  const world::Pose& pose = camera.pose;
  if (time_ >= 0.0 && passed > 0.0 && passed < kPause) {
    const auto seconds = static_cast<float>(passed);
    const auto mix = [](auto& mean, auto newest) { mean += kNewest * (newest - mean); };
    const world::Vec3 velocity = (pose.position - last_.position) / seconds;
    const bool isTeleport = glm::length(velocity) > kFastest;
    mix(secondsPerFrame_, seconds);
    mix(velocity_, isTeleport ? world::Vec3(0.0F) : velocity);
    yawRate_ = std::remainder(pose.yaw - last_.yaw, 2.0F * std::numbers::pi_v<float>) / seconds;
    pitchRate_ = (pose.pitch - last_.pitch) / seconds;
  } else if (passed >= kPause) {
    velocity_ = world::Vec3(0.0F);
    yawRate_ = 0.0F;
    pitchRate_ = 0.0F;
  }
  isAtRest_ = time_ >= 0.0 && pose == last_;
  last_ = pose;
  time_ = time;
}

world::Camera EyeMotion::ahead(world::Camera camera, float seconds) const {
  camera.pose.position += velocity_ * seconds;
  camera.pose.yaw += yawRate_ * seconds;
  camera.pose.pitch = std::clamp(camera.pose.pitch + pitchRate_ * seconds, -world::kMaxPitch, world::kMaxPitch);
  return camera;
}

}  // namespace grove::node
