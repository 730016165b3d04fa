#pragma once

#include <array>

#include "world/geometry.h"

namespace grove::objects::herd {

/// The three long bones of a leg, from the trunk to the hoof. Metres.
struct LegBones {
  float upper = 0.0F;
  float lower = 0.0F;
  float cannon = 0.0F;
  /// Which way the joint between upper and lower bone points: 1 forwards (a stifle), -1 backwards (an elbow).
  float joint = 1.0F;
  /// Lean of the cannon bone while the leg is stretched, and its increase with each unit by which the leg is shorter,
  /// relative to its length; forwards, radians.
  float lean = 0.0F;
  float fold = 0.0F;

  [[nodiscard]] float length() const noexcept { return upper + lower + cannon; }
};

/// Ends of a leg's bones, from the trunk to the sole.
using LegChain = std::array<world::Vec3, 4>;

/// Places a leg between its joint with the trunk and a foot: inverse kinematics with the cannon bone's direction given
/// by a rule, and the other two by the law of cosines. `forward` is the animal's direction, a unit vector. A foot out
/// of reach is pulled towards the joint.
[[nodiscard]] LegChain placeLeg(const LegBones& bones, world::Vec3 joint, world::Vec3 foot, world::Vec3 forward);

}  // namespace grove::objects::herd
