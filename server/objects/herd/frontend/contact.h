#pragma once

#include <array>

#include "objects/herd/common/animal_pose.h"
#include "objects/herd/frontend/affine.h"

namespace grove::objects::herd {

/// The plane that an animal stands on.
struct Ground {
  explicit Ground(const AnimalPose& pose);

  Affine height;      ///< metres above it
  world::Vec3 point;  ///< on it, between the feet

  /// The point of the plane above or below a point.
  [[nodiscard]] world::Vec3 below(world::Vec3 at) const noexcept { return {at.x, at.y - height.at(at), at.z}; }
};

/// Dimness of the ground below an animal, whose body hides the sky.
class Contact {
 public:
  Contact(const AnimalPose& pose, float size, const Ground& ground);

  /// Metres from the trunk's middle within which it is not zero.
  [[nodiscard]] float radius() const noexcept { return radius_; }
  /// The hidden share of the sky at a point of the ground, 0..1; `x` and `z` are relative to the animal's place.
  [[nodiscard]] float at(float x, float z) const noexcept;

 private:
  struct Foot {
    world::Vec2 at{0.0F};
    float strength = 0.0F;
  };
  world::Vec2 ahead_;
  float perLength_;
  float perWidth_;
  float trunkStrength_;
  float footReach_;
  float radius_;
  std::array<Foot, kLegs> feet_;
};

}  // namespace grove::objects::herd
