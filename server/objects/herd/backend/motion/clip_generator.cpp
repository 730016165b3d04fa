#include "objects/herd/backend/motion/clip_generator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "objects/herd/backend/motion/footfalls.h"
#include "objects/herd/backend/motion/gait.h"
#include "world/noise.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

/// Before and after a clip, so that it begins and ends in full motion.
constexpr float kLead = 1.5F;
constexpr int kStepsPerFrame = 4;
constexpr float kSlowest = 0.3F;  ///< of a walk, metres per second; slower steps are made while grazing
constexpr float kTrots = 1.8F;
constexpr float kGallops = 4.0F;

/// While an animal stands.
Posture standing(Activity activity) {
  switch (activity) {
    case Activity::kGraze:
      return {.rise = -0.02F, .pitch = -0.07F, .neckPitch = -0.92F, .headPitch = -1.2F, .tail = 0.05F, .ears = -0.1F};
    case Activity::kAlert:
      return {.rise = 0.012F, .pitch = 0.02F, .neckPitch = 0.98F, .headPitch = -0.18F, .tail = 0.3F, .ears = 0.9F};
    default:
      return {.neckPitch = 0.72F, .headPitch = -0.42F, .tail = 0.05F, .ears = 0.2F};
  }
}

Posture moving(float speed, float phase) {
  const Gait gait = gaitAt(speed);
  const float angle = kTurn * phase;
  const auto wave = [&](float delay) {
    return glm::mix(std::sin(2.0F * angle + delay), std::sin(angle + delay), gait.leaps);
  };
  const float fast = glm::smoothstep(kTrots - 0.5F, kTrots + 0.5F, speed);
  Posture posture;
  posture.rise = -0.012F * std::min(speed, 4.0F) + gait.bounce * wave(2.2F);
  posture.pitch = gait.rock * wave(0.3F);
  posture.neckPitch = gait.neck + gait.nod * wave(1.2F);
  posture.headPitch = -0.5F + 0.04F * std::min(speed, 6.0F) - 0.5F * gait.nod * wave(1.2F);
  posture.roll = 0.02F * (1.0F - fast) * std::sin(angle + 0.8F);
  posture.tail = gait.tail;
  posture.ears = 0.2F - 0.7F * fast;
  return posture;
}

/// Smooth noise, -1..1.
float wander(float seconds, float perSecond, std::uint32_t seed, float channel) {
  const Vec2 at(seconds * perSecond + 37.0F * channel, 0.37F + static_cast<float>(seed % 4096U));
  return 2.0F * world::noise(at) - 1.0F;
}

/// Turns of head and ears that show that an animal lives. `strength` 0..1.
void addGlances(Posture& posture, Activity activity, float strength, float seconds, std::uint32_t seed) {
  const bool grazes = activity == Activity::kGraze;
  const float size = strength * (activity == Activity::kAlert ? 0.12F : (grazes ? 0.3F : 0.6F));
  const float glance = wander(seconds, grazes ? 0.5F : 0.35F, seed, 1.0F);
  posture.neckYaw += size * glance;
  posture.headYaw += 0.5F * size * glance;
  posture.ears += 0.5F * wander(seconds, 1.3F, seed, 2.0F);
  posture.rise += 0.004F * std::sin(kTurn * 0.4F * seconds);  // breathes
  const float flick = wander(seconds, 2.2F, seed, 3.0F);
  posture.tail += 0.6F * std::max(0.0F, flick - 0.5F);
  if (grazes) {
    posture.headPitch += 0.07F * strength * wander(seconds, 2.6F, seed, 4.0F);
    posture.neckPitch += 0.05F * strength * wander(seconds, 0.8F, seed, 5.0F);
  }
}

Activity activityAt(const ClipPlan& plan, float seconds) {
  const float speed = plan.speed.at(seconds);
  if (speed > kGallops) return Activity::kGallop;
  if (speed > kTrots) return Activity::kTrot;
  if (speed > kSlowest) return Activity::kWalk;
  return seconds < plan.change + 0.5F * plan.changeSeconds ? plan.from : plan.to;
}

Posture postureAt(const ClipPlan& plan, float seconds, float phase) {
  const float speed = plan.speed.at(seconds);
  const float turn = plan.turn.at(seconds);
  const float change = glm::smoothstep(plan.change, plan.change + plan.changeSeconds, seconds);
  Posture rest = mixed(standing(plan.from), standing(plan.to), change);
  // Clips that begin and end without a glance fit together.
  const float strength = glm::smoothstep(0.2F, 0.9F, seconds) *
                         (1.0F - glm::smoothstep(plan.seconds - 0.9F, plan.seconds - 0.2F, seconds));
  addGlances(rest, change < 0.5F ? plan.from : plan.to, strength, seconds, plan.seed);
  Posture posture = mixed(rest, moving(speed, phase), glm::smoothstep(kSlowest, 0.8F, speed));
  posture.roll -= std::clamp(0.05F * turn * speed, -0.18F, 0.18F);
  posture.bend += std::clamp(0.22F * turn, -0.3F, 0.3F);
  posture.neckYaw += std::clamp(0.35F * turn, -0.5F, 0.5F);
  return posture;
}

}  // namespace

Clip makeClip(const ClipPlan& plan) {
  const Course course(plan.speed, plan.turn, -kLead, plan.seconds + kLead);
  constexpr int kFrames = static_cast<int>(kFramesPerSecond);
  const std::vector<Feet> feet = planFootfalls(course, plan.phase, kFrames * kStepsPerFrame);
  const auto count = static_cast<int>(std::lround(plan.seconds * kFramesPerSecond));
  const auto lead = static_cast<int>(std::lround(kLead * kFramesPerSecond));
  Clip clip;
  for (int i = 0; i < count; ++i) {
    const float seconds = static_cast<float>(i) / kFramesPerSecond;
    const int step = (lead + i) * kStepsPerFrame;
    const Feet& at = feet[static_cast<std::size_t>(step)];
    MotionFrame frame;
    frame.root = course.at(seconds);
    frame.posture = postureAt(plan, seconds, at.phase);
    frame.activity = activityAt(plan, seconds);
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      const Vec2 own = frame.root.own(Vec2(at.places[leg].x, at.places[leg].z) - frame.root.place);
      frame.feet[leg] = Vec3(own.x, at.places[leg].y, own.y);
      if (at.onGround[leg]) frame.contacts = static_cast<std::uint8_t>(frame.contacts | 1U << leg);
    }
    clip.push_back(frame);
  }
  return clip;
}

}  // namespace grove::objects::herd
