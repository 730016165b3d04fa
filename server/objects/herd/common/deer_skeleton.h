#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "objects/herd/common/animal_pose.h"
#include "objects/herd/common/leg_chain.h"
#include "world/geometry.h"

/// The bones of a fallow deer, and where a pose puts them. An animal's own coordinates: the origin on the ground below
/// the trunk's middle, x to the right, y up, facing -Z; metres of an animal of size 1.
namespace grove::objects::herd {

/// Parts of the body that move as a whole. A leg has three, from the trunk downwards.
enum Bone : std::uint8_t {
  kPelvis,
  kChest,
  kLowerNeck,
  kUpperNeck,
  kHead,
  kTail,
  kLeftEar,
  kRightEar,
  kFirstLegBone,
  kBones = kFirstLegBone + 3 * kLegs,
};

inline constexpr float kTrunkHeight = 0.80F;  ///< of the spine's middle, while the animal stands
inline constexpr world::Vec3 kNeckRoot{0.0F, 0.88F, -0.38F};
inline constexpr float kLowerNeckLength = 0.27F;
inline constexpr float kUpperNeckLength = 0.27F;
inline constexpr float kHeadLength = 0.26F;  ///< from the neck's end to the muzzle
inline constexpr world::Vec3 kTailRoot{0.0F, 0.855F, 0.505F};
inline constexpr world::Vec3 kLeftEarRoot{-0.055F, 0.075F, 0.02F};  ///< from the neck's end, of a level head

/// Where a leg joins the standing trunk.
[[nodiscard]] world::Vec3 legRoot(Leg leg) noexcept;
[[nodiscard]] const LegBones& legBones(Leg leg) noexcept;

/// Returns the matrices that take each bone from its rest position to the world. In the rest position, the spine is
/// straight, neck and head point ahead (-Z), the tail back (+Z) and the ears up, and the bones of each leg hang
/// straight down from its legRoot(). `size` scales the animal about `pose.place`; its feet are where the pose says.
[[nodiscard]] std::array<world::Mat4, kBones> bonesOf(const AnimalPose& pose, float size);

/// The legs of a pose in the world.
[[nodiscard]] std::array<LegChain, kLegs> legsOf(const AnimalPose& pose, float size);

/// Size of the largest animal.
inline constexpr float kLargest = 1.12F;
/// Largest height of a pose, and its largest horizontal distance from `place`, for an animal of size 1. Metres.
inline constexpr float kTallest = 1.90F;
inline constexpr float kReach = 1.50F;

}  // namespace grove::objects::herd
