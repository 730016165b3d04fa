#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "objects/herd/backend/motion/root_move.h"
#include "objects/herd/common/animal_pose.h"

namespace grove::objects::herd {

/// What an animal does.
enum class Activity : std::uint8_t { kStand, kGraze, kAlert, kWalk, kTrot, kGallop };
inline constexpr std::size_t kActivities = 6;

inline constexpr float kFramesPerSecond = 30.0F;

/// An animal of size 1 on level ground, relative to its root.
struct MotionFrame {
  RootMove root;  ///< relative to the clip's first frame
  Posture posture;
  std::array<world::Vec3, kLegs> feet{};  ///< x and z to the right and back of the root, y above the ground
  std::uint8_t contacts = 0;              ///< bit i: foot i is on the ground
  Activity activity = Activity::kStand;

  [[nodiscard]] bool isOnGround(std::size_t leg) const noexcept { return (contacts >> leg & 1U) != 0; }
};

/// A piece of motion, kFramesPerSecond.
using Clip = std::vector<MotionFrame>;

}  // namespace grove::objects::herd
