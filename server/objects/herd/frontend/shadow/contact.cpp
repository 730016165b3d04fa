#include "objects/herd/frontend/shadow/contact.h"

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
    : ahead(-std::sin(pose.yaw), -std::cos(pose.yaw)),
      perLength(1.0F / (kTrunkLength * size)),
      perWidth(1.0F / (kTrunkWidth * size)),
      footReach(kFootReach * size),
      radius(kTrunkLength * size) {
  // A trunk near the ground hides more of the sky.
  const float height = std::max(0.2F, (kTrunkHeight + pose.posture.rise / std::max(size, 0.1F)) / kTrunkHeight);
  trunkStrength = std::min(0.7F, kTrunkStrength / height);
  for (std::size_t i = 0; i < kLegs; ++i) {
    const float lift = ground.height.at(pose.feet[i]);
    const float near = std::clamp(1.0F - lift / (kFootLift * size), 0.0F, 1.0F);
    feet[i] = {Vec2(pose.feet[i].x - pose.place.x, pose.feet[i].z - pose.place.z), kFootStrength * near};
    radius = std::max(radius, glm::length(feet[i].at) + footReach);
  }
}

}  // namespace grove::objects::herd
