#include "stream/load/walk_follower.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace grove::stream {
namespace {

using world::Vec3;

/// Look-ahead in which keys are compared: about as long as a change of velocity takes.
constexpr float kAheadSeconds = 0.1F;
constexpr float kNear = 0.15F;       // metres
constexpr float kSlowWithin = 1.0F;  // metres

struct Motion {
  Vec3 moved;
  Vec3 velocity;
};

/// One step of the motion of world::Players: the velocity approaches the wanted one exponentially.
Motion motion(Vec3 velocity, Vec3 wanted, float seconds) {
  const float share = 1.0F - std::exp(-world::kAcceleration * seconds);
  return {wanted * seconds + (velocity - wanted) * (share / world::kAcceleration),
          velocity + (wanted - velocity) * share};
}

float distance(Vec3 a, Vec3 b) { return std::hypot(a.x - b.x, a.z - b.z); }

}  // namespace

WalkFollower::WalkFollower(const WalkToFollow& plan, Vec3 arrived, double offset)
    : plan_(plan), offset_(offset), position_(arrived) {}

world::Input WalkFollower::steer(double seconds) {
  advance(seconds);
  const world::Pose start = plan_.walk.thereAndBack(offset_);
  if (!isOnWalk() && distance(position_, start.position) < kNear) beganAt_ = seconds;
  if (isOnWalk()) {
    const double onWalk = offset_ + seconds - beganAt_;
    const world::Pose now = plan_.walk.thereAndBack(onWalk);
    const world::Pose soon = plan_.walk.thereAndBack(onWalk + static_cast<double>(kAheadSeconds));
    held_.yaw = now.yaw;
    held_.pitch = now.pitch;
    held_.keys = keysTowards(soon.position, now.yaw, kAheadSeconds);
  } else {
    held_ = approach(start);
  }
  return held_;
}

void WalkFollower::advance(double seconds) {
  const auto passed = static_cast<float>(std::max(seconds - time_, 0.0));
  const Motion done = motion(velocity_, world::wantedVelocity(held_.keys, held_.yaw), passed);
  position_ += done.moved;
  velocity_ = done.velocity;
  time_ = seconds;
}

world::Input WalkFollower::approach(const world::Pose& start) const {
  const Vec3 way = start.position - position_;
  world::Input input;
  input.yaw = std::atan2(-way.x, -way.z);
  input.keys = keysTowards(start.position, input.yaw, kAheadSeconds);
  if (distance(position_, start.position) > kSlowWithin) input.keys = world::kForward | world::kRun;
  return input;
}

std::uint8_t WalkFollower::keysTowards(Vec3 place, float yaw, float seconds) const {
  constexpr std::array<std::uint8_t, 3> kAlong = {0, world::kForward, world::kBack};
  constexpr std::array<std::uint8_t, 3> kAcross = {0, world::kLeft, world::kRight};
  constexpr std::array<std::uint8_t, 2> kPace = {0, world::kRun};
  std::uint8_t best = 0;
  float nearest = std::numeric_limits<float>::infinity();
  for (const std::uint8_t along : kAlong) {
    for (const std::uint8_t across : kAcross) {
      for (const std::uint8_t pace : kPace) {
        const auto keys = static_cast<std::uint8_t>(along | across | pace);
        const Vec3 moved = motion(velocity_, world::wantedVelocity(keys, yaw), seconds).moved;
        const float miss = distance(position_ + moved, place);
        if (miss >= nearest) continue;
        nearest = miss;
        best = keys;
      }
    }
  }
  return best;
}

}  // namespace grove::stream
