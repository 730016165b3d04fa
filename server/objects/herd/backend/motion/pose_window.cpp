#include "objects/herd/backend/motion/pose_window.h"

#include <cmath>

#include "objects/herd/common/deer_skeleton.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

constexpr float kNeckMetres = 0.5F;
constexpr float kHeadMetres = 0.25F;

/// The muzzle, relative to the root. The length of the neck is what counts.
Vec3 muzzleOf(const Posture& posture) {
  const auto ahead = [](float pitch, float yaw, float length) {
    return length * Vec3(-std::cos(pitch) * std::sin(yaw), std::sin(pitch), -std::cos(pitch) * std::cos(yaw));
  };
  return kNeckRoot + ahead(posture.neckPitch, posture.neckYaw, kNeckMetres) +
         ahead(posture.headPitch, posture.neckYaw + posture.headYaw, kHeadMetres);
}

}  // namespace

bool hasWindow(const MotionDatabase& database, MotionDatabase::Frame frame) {
  return frame + kBlendFrames < database.endOf(frame);
}

PoseWindow windowAt(const MotionDatabase& database, MotionDatabase::Frame frame) {
  PoseWindow window;
  window.frame = frame;
  const MotionFrame& middle = database[frame + kBlendFrames / 2];
  window.contacts = middle.contacts;
  const float seconds = static_cast<float>(kBlendFrames - 1) / kFramesPerSecond;
  window.speed = glm::distance(database[frame].root.place, database[frame + kBlendFrames - 1].root.place) / seconds;
  std::size_t at = 0;
  const auto put = [&](Vec3 point) {
    for (int axis = 0; axis < 3; ++axis) window.points[at++] = point[axis];
  };
  for (const std::uint32_t offset : {0U, kBlendFrames / 2, kBlendFrames - 1}) {
    const MotionFrame& one = database[frame + offset];
    const RootMove root = middle.root.to(one.root);
    const auto seen = [&](Vec3 point) {
      const Vec2 place = root.place + root.turned({point.x, point.z});
      return Vec3(place.x, point.y, place.y);
    };
    for (const Vec3& foot : one.feet) put(seen(foot));
    // A head turns freely, but a trunk that jumps is seen.
    put(0.6F * seen(muzzleOf(one.posture)));
    put(2.0F * seen(Vec3(0.0F, one.posture.rise, -0.3F * one.posture.pitch)));
  }
  return window;
}

float distance(const PoseWindow& a, const PoseWindow& b) noexcept {
  float sum = 0.0F;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const float difference = a.points[i] - b.points[i];
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<float>(PoseWindow::kPoints));
}

}  // namespace grove::objects::herd
