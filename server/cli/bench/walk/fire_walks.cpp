#include "cli/bench/walk/fire_walks.h"

#include <cmath>
#include <utility>
#include <vector>

#include "world/players.h"

namespace grove::cli {
namespace {

using world::Pose;
using world::Vec3;

/// Metres from the fire, for standing and for walking around it.
constexpr float kStandingDistance = 5.0F;
constexpr float kWalkingDistance = 7.0F;

/// A pose of a walk: the eye's height counts from the ground, unlike the target's.
Pose lookingAt(Vec3 eye, Vec3 target, const world::Layout& layout) {
  Pose pose;
  pose.position = eye;
  const Vec3 way = target - onGround(pose, layout.hills).position;
  pose.yaw = std::atan2(-way.x, -way.z);
  pose.pitch = std::atan2(way.y, std::hypot(way.x, way.z));
  return pose;
}

Vec3 fireOf(const world::Layout& layout) {
  return layout.lights.empty() ? Vec3(0.0F) : layout.lights.front().light.position;
}

}  // namespace

world::Walk roundWalk(const world::Layout& layout) {
  constexpr double kStepSeconds = 0.1;
  constexpr int kSteps = 200;
  const Vec3 fire = fireOf(layout);
  const float start = std::atan2(layout.spawn.x - fire.x, layout.spawn.z - fire.z);
  std::vector<world::Walk::Step> steps;
  for (int i = 0; i <= kSteps; ++i) {
    const auto time = static_cast<float>(i * kStepSeconds);
    const float angle = start + time * world::kWalkSpeed / kWalkingDistance;
    const Vec3 outwards(std::sin(angle), 0.0F, std::cos(angle));
    Pose pose = lookingAt(Vec3(fire.x, world::kEyeHeight, fire.z) + outwards * kWalkingDistance, fire, layout);
    pose.yaw -= 0.8F * (1.0F - std::cos(0.7F * time));
    pose.pitch += 0.08F * std::sin(0.9F * time);
    steps.push_back({i * kStepSeconds, pose});
  }
  return world::Walk(std::move(steps));
}

world::Walk standingWalk(const world::Layout& layout) {
  const Vec3 fire = fireOf(layout);
  const Vec3 outwards = glm::normalize(Vec3(layout.spawn.x - fire.x, 0.0F, layout.spawn.z - fire.z));
  const Vec3 eye = Vec3(fire.x, world::kEyeHeight, fire.z) + outwards * kStandingDistance;
  return world::Walk({{0.0, lookingAt(eye, fire, layout)}});
}

}  // namespace grove::cli
