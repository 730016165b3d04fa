#include "objects/herd/frontend/contact.h"

#include <algorithm>
#include <cmath>

#include "objects/herd/common/deer_skeleton.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

// Metres for an animal of size 1.
constexpr float kTrunkLength = 0.74F;  // half of it
constexpr float kTrunkWidth = 0.38F;   // the same
constexpr float kFootReach = 0.11F;
constexpr float kFootLift = 0.12F;  // a hoof that high leaves no shadow below it

constexpr float kTrunkStrength = 0.34F;
constexpr float kFootStrength = 0.50F;

float square(float value) { return value * value; }

/// Slope of the plane through the feet along an axis: the difference between fore and hind feet, or left and right.
float slopeBetween(Vec3 from, Vec3 to) {
  const float length = std::hypot(to.x - from.x, to.z - from.z);
  return length < 0.05F ? 0.0F : (to.y - from.y) / length;
}

}  // namespace

Ground::Ground(const AnimalPose& pose) : point(0.25F * (pose.feet[0] + pose.feet[1] + pose.feet[2] + pose.feet[3])) {
  // A lifted hoof is not on the ground: of each pair, the lower one is.
  const auto lower = [&](Leg a, Leg b) {
    return Vec3(0.5F * (pose.feet[a].x + pose.feet[b].x), std::min(pose.feet[a].y, pose.feet[b].y),
                0.5F * (pose.feet[a].z + pose.feet[b].z));
  };
  const Vec3 fore = lower(kLeftFore, kRightFore);
  const Vec3 hind = lower(kLeftHind, kRightHind);
  constexpr float kSteepest = 0.5F;
  const float slope = std::clamp(slopeBetween(hind, fore), -kSteepest, kSteepest);
  const Vec3 ahead(-std::sin(pose.yaw), 0.0F, -std::cos(pose.yaw));
  point.y = 0.5F * (fore.y + hind.y);
  height.slope = Vec3(0.0F, 1.0F, 0.0F) - slope * ahead;
  height.start = -glm::dot(height.slope, point);
}

Contact::Contact(const AnimalPose& pose, float size, const Ground& ground)
    : ahead_(-std::sin(pose.yaw), -std::cos(pose.yaw)),
      perLength_(1.0F / (kTrunkLength * size)),
      perWidth_(1.0F / (kTrunkWidth * size)),
      footReach_(kFootReach * size),
      radius_(kTrunkLength * size) {
  // A trunk near the ground hides more of the sky.
  const float height = std::max(0.2F, (kTrunkHeight + pose.posture.rise / std::max(size, 0.1F)) / kTrunkHeight);
  trunkStrength_ = std::min(0.7F, kTrunkStrength / height);
  for (std::size_t i = 0; i < kLegs; ++i) {
    const float lift = ground.height.at(pose.feet[i]);
    const float near = std::clamp(1.0F - lift / (kFootLift * size), 0.0F, 1.0F);
    feet_[i] = {Vec2(pose.feet[i].x - pose.place.x, pose.feet[i].z - pose.place.z), kFootStrength * near};
    radius_ = std::max(radius_, glm::length(feet_[i].at) + footReach_);
  }
}

float Contact::at(float x, float z) const noexcept {
  if (x * x + z * z > radius_ * radius_) return 0.0F;
  const float along = (x * ahead_.x + z * ahead_.y) * perLength_;
  const float aside = (x * ahead_.y - z * ahead_.x) * perWidth_;
  const float trunk = std::max(0.0F, 1.0F - along * along - aside * aside);
  float light = 1.0F - trunkStrength_ * trunk * std::sqrt(trunk);
  for (const Foot& foot : feet_) {
    const float off = (square(x - foot.at.x) + square(z - foot.at.y)) / square(footReach_);
    if (off < 1.0F) light *= 1.0F - foot.strength * square(1.0F - off);
  }
  return 1.0F - light;
}

}  // namespace grove::objects::herd
