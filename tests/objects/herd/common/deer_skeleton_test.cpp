#include "objects/herd/common/deer_skeleton.h"

#include <gtest/gtest.h>

#include "objects/herd/poses.h"

namespace grove::objects::herd {
namespace {

using world::Vec3;

constexpr float kMillimetre = 0.001F;

Vec3 moved(const world::Mat4& bone, Vec3 rest) { return Vec3(bone * world::Vec4(rest, 1.0F)); }

/// Where a leg's joint is in the rest position: 0 at the trunk, 3 at the sole.
Vec3 restJoint(Leg leg, std::size_t joint) {
  const LegBones& bones = legBones(leg);
  const std::array<float, 4> below{0.0F, bones.upper, bones.upper + bones.lower, bones.length()};
  return legRoot(leg) - Vec3(0.0F, below[joint], 0.0F);
}

std::vector<AnimalPose> somePoses() {
  AnimalPose bent = walkingAt({2, 0.3F, -1}, 2.0F);
  bent.posture.bend = 0.3F;
  bent.posture.roll = 0.05F;
  bent.posture.pitch = 0.08F;
  bent.posture.neckYaw = 0.6F;
  return {standingAt({0, 0, 0}), standingAt({5, 1, -3}, 1.0F), walkingAt({1, 0, 1}, -2.0F), grazingAt({0, 0, 2}), bent};
}

/// Would catch legs that are too short for a stride: hooves would float or slide.
TEST(DeerSkeletonTest, LegsReachTheFeet) {
  for (const float ahead : {-0.25F, 0.0F, 0.25F}) {
    for (const float lift : {0.0F, 0.15F}) {
      AnimalPose pose = standingAt({1, 0.5F, 2}, 0.7F);
      const Vec3 step = ahead * Vec3(-std::sin(0.7F), 0.0F, -std::cos(0.7F)) + Vec3(0.0F, lift, 0.0F);
      for (Vec3& foot : pose.feet) foot += step;
      const auto legs = legsOf(pose, 1.0F);
      for (std::size_t i = 0; i < kLegs; ++i) {
        EXPECT_LT(glm::distance(legs[i][3], pose.feet[i]), kMillimetre) << "leg " << i << ", " << ahead << ", " << lift;
      }
    }
  }
}

/// Would catch bones that stretch while a leg bends.
TEST(DeerSkeletonTest, LegBonesKeepTheirLengths) {
  for (const AnimalPose& pose : somePoses()) {
    const auto legs = legsOf(pose, 1.0F);
    for (std::size_t i = 0; i < kLegs; ++i) {
      const LegBones& bones = legBones(static_cast<Leg>(i));
      EXPECT_NEAR(glm::distance(legs[i][0], legs[i][1]), bones.upper, kMillimetre);
      EXPECT_NEAR(glm::distance(legs[i][1], legs[i][2]), bones.lower, kMillimetre);
      EXPECT_NEAR(glm::distance(legs[i][2], legs[i][3]), bones.cannon, kMillimetre);
    }
  }
}

/// Would catch knees that jump while a hoof moves evenly.
TEST(DeerSkeletonTest, JointsMoveEvenly) {
  constexpr int kSteps = 400;
  for (const Leg leg : {kLeftFore, kLeftHind}) {
    LegChain before{};
    for (int i = 0; i <= kSteps; ++i) {
      AnimalPose pose = standingAt({0, 0, 0});
      const float along = static_cast<float>(i) / kSteps;
      pose.feet[leg] += Vec3(0.0F, 0.10F * std::sin(3.0F * along), 0.5F * along - 0.25F);
      const LegChain chain = legsOf(pose, 1.0F)[leg];
      for (std::size_t joint = 0; i > 0 && joint < chain.size(); ++joint) {
        EXPECT_LT(glm::distance(chain[joint], before[joint]), 0.02F) << "leg " << leg << ", joint " << joint;
      }
      before = chain;
    }
  }
}

/// Would catch hocks and elbows that bend the wrong way.
TEST(DeerSkeletonTest, JointsBendTheirWay) {
  const auto legs = legsOf(standingAt({0, 0, 0}), 1.0F);
  EXPECT_GT(legs[kLeftFore][1].z, legs[kLeftFore][0].z) << "the elbow points backwards";
  EXPECT_LT(legs[kLeftHind][1].z, legs[kLeftHind][0].z) << "the stifle points forwards";
  EXPECT_GT(legs[kLeftHind][2].z, legs[kLeftHind][1].z) << "the hock points backwards";
}

/// Would catch sheared or mirrored parts, whose light would be wrong.
TEST(DeerSkeletonTest, BonesAreRigidApartFromTheSize) {
  for (const AnimalPose& pose : somePoses()) {
    for (const float size : {1.0F, 0.6F}) {
      for (const world::Mat4& bone : bonesOf(pose, size)) {
        const glm::mat3 turn = glm::mat3(bone) / size;
        const glm::mat3 unit = glm::transpose(turn) * turn;
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) EXPECT_NEAR(unit[i][j], i == j ? 1.0F : 0.0F, 1.0e-4F);
        }
        EXPECT_NEAR(glm::determinant(turn), 1.0F, 1.0e-3F);
      }
    }
  }
}

/// Would catch legs that fall apart.
TEST(DeerSkeletonTest, NeighbouringLegBonesMeetAtTheirJoints) {
  for (const AnimalPose& pose : somePoses()) {
    const auto bones = bonesOf(pose, 1.0F);
    const auto legs = legsOf(pose, 1.0F);
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      for (std::size_t joint = 0; joint < 4; ++joint) {
        const Vec3 rest = restJoint(static_cast<Leg>(leg), joint);
        const std::size_t first = kFirstLegBone + 3 * leg;
        if (joint > 0) {
          EXPECT_LT(glm::distance(moved(bones[first + joint - 1], rest), legs[leg][joint]), kMillimetre);
        }
        if (joint < 3) {
          EXPECT_LT(glm::distance(moved(bones[first + joint], rest), legs[leg][joint]), kMillimetre);
        }
      }
    }
  }
}

/// Would catch a neck that comes off the trunk, or a head off the neck.
TEST(DeerSkeletonTest, NeckAndHeadHangTogether) {
  const Vec3 middle = kNeckRoot - Vec3(0.0F, 0.0F, kLowerNeckLength);
  const Vec3 end = middle - Vec3(0.0F, 0.0F, kUpperNeckLength);
  for (const AnimalPose& pose : somePoses()) {
    const auto bones = bonesOf(pose, 1.0F);
    EXPECT_LT(glm::distance(moved(bones[kChest], kNeckRoot), moved(bones[kLowerNeck], kNeckRoot)), kMillimetre);
    EXPECT_LT(glm::distance(moved(bones[kLowerNeck], middle), moved(bones[kUpperNeck], middle)), kMillimetre);
    EXPECT_LT(glm::distance(moved(bones[kUpperNeck], end), moved(bones[kHead], end)), kMillimetre);
  }
}

/// Would catch an animal that turns all the way round between two ticks.
TEST(DeerSkeletonTest, PosesTurnTheShorterWay) {
  const AnimalPose from = standingAt({0, 0, 0}, 3.1F);
  const AnimalPose to = standingAt({1, 0, 0}, -3.1F);
  const AnimalPose half = mixed(from, to, 0.5F);
  EXPECT_NEAR(std::abs(std::remainder(half.yaw, 6.2831853F)), 3.14159F, 0.01F);
  EXPECT_NEAR(half.place.x, 0.5F, 1.0e-6F);
}

}  // namespace
}  // namespace grove::objects::herd
