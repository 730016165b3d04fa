#include "stream/load/steering.h"

#include "stream/session/stroll.h"

namespace grove::stream {
namespace {

/// Between consecutive visitors on a walk.
constexpr double kSecondsApart = 2.3;

}  // namespace

Steering::Steering(int index, const LoadPlan& plan, const Welcome& welcome)
    : index_(index), movement_(plan.movement), yaw_(welcome.yaw), pitch_(welcome.pitch) {
  if (!plan.follow) return;
  const world::Vec3 arrived = world::placeOfArrival(welcome.visitor, plan.follow->spawn, plan.follow->spawnYaw);
  follower_.emplace(*plan.follow, arrived, kSecondsApart * index);
}

world::Input Steering::at(double seconds) {
  if (follower_) return follower_->steer(seconds);
  world::Input input = stroll(index_, yaw_, seconds);
  if (movement_ != Movement::kStroll) input.keys = 0;
  if (movement_ == Movement::kStand) {
    input.yaw = yaw_;
    input.pitch = pitch_;
  }
  return input;
}

}  // namespace grove::stream
