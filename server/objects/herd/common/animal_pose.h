#pragma once

#include <array>
#include <cstddef>

#include "world/geometry.h"

namespace grove::objects::herd {

enum Leg : std::size_t { kLeftFore, kRightFore, kLeftHind, kRightHind };
inline constexpr std::size_t kLegs = 4;

/// Trunk, neck, head, tail and ears, relative to where the animal is. Angles in radians; pitch grows upwards, yaw to
/// the left, as in world::Pose.
struct Posture {
  float rise = 0.0F;       ///< of the trunk, metres above where it is while the animal stands
  float pitch = 0.0F;      ///< of the trunk
  float roll = 0.0F;       ///< of the trunk, to the right
  float bend = 0.0F;       ///< of the spine, the fore half's yaw relative to the hind half
  float neckPitch = 0.0F;  ///< of the whole neck, relative to the horizontal
  float neckYaw = 0.0F;
  float headPitch = 0.0F;  ///< of the muzzle, relative to the horizontal
  float headYaw = 0.0F;    ///< relative to the neck
  float tail = 0.0F;       ///< 0 hangs, 1 up
  float ears = 0.0F;       ///< -1 backwards, 0 sideways, 1 forwards
};
inline constexpr std::size_t kPostureValues = 10;
static_assert(sizeof(Posture) == kPostureValues * sizeof(float));

/// One animal at one time, in the world.
struct AnimalPose {
  world::Vec3 place{0.0F};  ///< on the ground below the trunk's middle
  float yaw = 0.0F;         ///< as world::Pose
  Posture posture;
  std::array<world::Vec3, kLegs> feet{};  ///< hooves' soles
};

/// Interpolates between two near poses; turns the shorter way. A foot at the same place in both stays there exactly.
[[nodiscard]] AnimalPose mixed(const AnimalPose& from, const AnimalPose& to, float share);
[[nodiscard]] Posture mixed(const Posture& from, const Posture& to, float share);

}  // namespace grove::objects::herd
