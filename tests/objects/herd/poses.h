#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "objects/herd/common/deer_skeleton.h"

namespace grove::objects::herd {

/// Stands on level ground at `place`, its head up.
[[nodiscard]] inline AnimalPose standingAt(world::Vec3 place, float yaw = 0.0F, float size = 1.0F) {
  AnimalPose pose;
  pose.place = place;
  pose.yaw = yaw;
  pose.posture.neckPitch = 0.9F;
  pose.posture.headPitch = -0.35F;
  const world::Mat4 turn = glm::rotate(world::Mat4(1.0F), yaw, world::Vec3(0, 1, 0));
  for (std::size_t i = 0; i < kLegs; ++i) {
    world::Vec3 foot = size * legRoot(static_cast<Leg>(i));
    foot.y = 0.0F;
    pose.feet[i] = place + world::Vec3(turn * world::Vec4(foot, 0.0F));
  }
  return pose;
}

/// The middle of a stride: two hooves ahead, one of them lifted, and two behind.
[[nodiscard]] inline AnimalPose walkingAt(world::Vec3 place, float yaw = 0.0F) {
  AnimalPose pose = standingAt(place, yaw);
  const world::Vec3 ahead(-std::sin(yaw), 0.0F, -std::cos(yaw));
  pose.feet[kLeftFore] += 0.22F * ahead;
  pose.feet[kRightFore] -= 0.22F * ahead;
  pose.feet[kLeftHind] -= 0.22F * ahead;
  pose.feet[kRightHind] += 0.1F * ahead + world::Vec3(0.0F, 0.12F, 0.0F);
  return pose;
}

[[nodiscard]] inline AnimalPose grazingAt(world::Vec3 place, float yaw = 0.0F) {
  AnimalPose pose = standingAt(place, yaw);
  pose.posture.neckPitch = -0.9F;
  pose.posture.headPitch = -1.3F;
  return pose;
}

}  // namespace grove::objects::herd
