#pragma once

#include <array>

#include "objects/herd/common/animal_pose.h"

namespace grove::objects::herd {

/// How an animal's legs take turns. A stride is one step of each leg.
struct Gait {
  float strides = 1.0F;  ///< per second
  float duty = 0.65F;    ///< share of a stride that a foot is on the ground
  /// When in a stride each foot comes down, in strides.
  std::array<float, kLegs> offsets{};
  float lift = 0.08F;   ///< height of a swinging foot, metres
  float bounce = 0.0F;  ///< of the trunk, metres
  float rock = 0.0F;    ///< of the trunk's pitch, radians
  float leaps = 0.0F;   ///< 0: trunk and neck move twice per stride, 1: once
  float neck = 0.6F;    ///< pitch of the neck, radians
  float nod = 0.0F;     ///< of the neck, radians
  float tail = 0.1F;
};

/// The gait of a speed in metres per second, for an animal of size 1: a walk in lateral sequence, a trot from 2 m/s and
/// a transverse gallop from 4.5 m/s on; between them, the legs' turns change smoothly. After Alexander, "Estimates of
/// Speeds of Dinosaurs" (1976) and Hildebrand, "The Quadrupedal Gaits of Vertebrates" (1989).
[[nodiscard]] Gait gaitAt(float speed) noexcept;

}  // namespace grove::objects::herd
