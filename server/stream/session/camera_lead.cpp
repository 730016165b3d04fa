#include "stream/session/camera_lead.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace grove::stream {
namespace {

/// Radians. A turn that ends misses as much of the picture on the other side.
constexpr double kMaxTurn = 0.3;
/// Seconds. Rates over a longer time are those of an earlier turn.
constexpr double kMaxPause = 0.25;

}  // namespace

float TurnLead::turnAhead(float angle, double sinceLast, double seconds) {
  const double change = std::remainder(double{angle} - std::exchange(last_, angle), 2.0 * std::numbers::pi);
  const double rate = sinceLast > 0.0 && sinceLast < kMaxPause ? change / sinceLast : 0.0;
  const double before = std::exchange(rate_, rate);
  if (rate * before <= 0.0) return 0.0F;
  const double steady = std::abs(rate) < std::abs(before) ? rate : before;
  return static_cast<float>(std::clamp(steady * seconds, -kMaxTurn, kMaxTurn));
}

world::Pose CameraLead::poseAhead(const world::Players& players, const world::Player& visitor, double seconds,
                                  double now) {
  const double sinceLast = now - std::exchange(lastTime_, now);
  world::Pose pose = visitor.pose;
  pose.yaw += yaw_.turnAhead(visitor.pose.yaw, sinceLast, seconds);
  pose.pitch = std::clamp(pose.pitch + pitch_.turnAhead(visitor.pose.pitch, sinceLast, seconds), -world::kMaxPitch,
                          world::kMaxPitch);
  if (seconds > 0.0) pose.position = players.eyeAhead(visitor, seconds);
  return pose;
}

}  // namespace grove::stream
