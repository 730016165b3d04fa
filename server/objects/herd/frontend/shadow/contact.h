#pragma once

#include <array>

#include "objects/herd/common/animal_pose.h"
#include "objects/herd/frontend/shadow/affine.h"

namespace grove::objects::herd {

/// The plane that an animal stands on.
struct Ground {
  explicit Ground(const AnimalPose& pose);

  Affine height;      ///< metres above it
  world::Vec3 point;  ///< on it, between the feet

  /// The point of the plane above or below a point.
  [[nodiscard]] world::Vec3 below(world::Vec3 at) const noexcept { return {at.x, at.y - height.at(at), at.z}; }
};

/// Dimness of the ground below an animal, whose body hides the sky: an ellipse below the trunk, and a small disc around
/// each hoof. Plain data for the kernel that draws it. Horizontal places (x, z) are relative to the animal's.
struct Contact {
  struct Foot {
    world::Vec2 at{0.0F};
    float strength = 0.0F;  ///< hidden share of the sky at its middle
  };

  Contact(const AnimalPose& pose, float size, const Ground& ground);

  world::Vec2 ahead;    ///< unit vector along the trunk
  float perLength;      ///< 1 / half the ellipse's length in metres
  float perWidth;       ///< the same, across
  float trunkStrength;  ///< hidden share of the sky at the middle
  float footReach;      ///< radius of the discs, metres
  float radius;         ///< metres from the animal's place within which anything is hidden
  std::array<Foot, kLegs> feet;
};

}  // namespace grove::objects::herd
