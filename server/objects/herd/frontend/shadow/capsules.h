#pragma once

#include <array>

#include "objects/herd/common/deer_skeleton.h"

namespace grove::objects::herd {

/// A thick line, in the world. Metres.
struct Capsule {
  world::Vec3 from{0.0F};
  world::Vec3 to{0.0F};
  float fromRadius = 0.0F;
  float toRadius = 0.0F;
};

inline constexpr std::size_t kHeadCapsule = 4;
inline constexpr std::size_t kCapsules = kHeadCapsule + 1 + 3 * kLegs + 2;
using Capsules = std::array<Capsule, kCapsules>;

/// An animal as thick lines: trunk, neck, head, three for each leg, and antlers. Without antlers, the last two are
/// points within the head.
[[nodiscard]] Capsules capsulesOf(const AnimalPose& pose, float size, bool hasAntlers);

}  // namespace grove::objects::herd
