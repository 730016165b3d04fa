#include "objects/herd/common/deer_skeleton.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::herd {
namespace {

using world::Mat4;
using world::Vec3;

constexpr float kTurn = 6.2831853F;
const Vec3 kRight(1, 0, 0);
const Vec3 kUp(0, 1, 0);
const Vec3 kBack(0, 0, 1);

constexpr LegBones kForeLeg{0.24F, 0.275F, 0.28F, -1.0F, -0.18F, 2.6F};
constexpr LegBones kHindLeg{0.31F, 0.32F, 0.32F, 1.0F, -0.40F, 2.4F};

/// Shoulder blades swing with the leg.
constexpr float kBladeShare = 0.40F;
constexpr float kBladeMost = 0.11F;

/// Matrices of the trunk's two halves.
struct Trunk {
  Mat4 pelvis;
  Mat4 chest;
};

Mat4 rotatedAt(const Mat4& matrix, Vec3 pivot, float angle, Vec3 axis) {
  return glm::translate(glm::rotate(glm::translate(matrix, pivot), angle, axis), -pivot);
}

Mat4 rootOf(const AnimalPose& pose, float size) {
  Mat4 root = glm::translate(Mat4(1.0F), pose.place);
  root = glm::rotate(root, pose.yaw, kUp);
  return glm::scale(root, Vec3(size));
}

Trunk trunkOf(const AnimalPose& pose, float size) {
  const Posture& posture = pose.posture;
  const Vec3 middle(0.0F, kTrunkHeight, 0.0F);
  Mat4 trunk = glm::translate(rootOf(pose, size), Vec3(0.0F, posture.rise, 0.0F));
  trunk = rotatedAt(trunk, middle, posture.pitch, kRight);
  trunk = rotatedAt(trunk, middle, -posture.roll, kBack);
  return {rotatedAt(trunk, middle, -0.5F * posture.bend, kUp), rotatedAt(trunk, middle, 0.5F * posture.bend, kUp)};
}

/// Returns the matrices of the neck's lower half, its upper half and the head. Both halves bend equally.
std::array<Mat4, 3> neckAndHead(const Trunk& trunk, const AnimalPose& pose) {
  const Posture& posture = pose.posture;
  const Vec3 joint = kNeckRoot - kLowerNeckLength * kBack;
  const Vec3 end = joint - kUpperNeckLength * kBack;
  // The chest's pitch does not lift the head.
  const float pitch = posture.neckPitch - posture.pitch;
  // The neck is an arc: its lower half is flatter than its end.
  const float curve = 0.12F + 0.10F * std::max(0.0F, posture.neckPitch);
  Mat4 lower = rotatedAt(trunk.chest, kNeckRoot, 0.5F * posture.neckYaw, kUp);
  lower = rotatedAt(lower, kNeckRoot, pitch - curve, kRight);
  Mat4 upper = rotatedAt(lower, joint, 2.0F * curve, kRight);
  const float upperPitch = posture.neckPitch + curve;
  upper = rotatedAt(upper, joint, 0.5F * posture.neckYaw, kUp);
  Mat4 head = rotatedAt(upper, end, posture.headPitch - upperPitch, kRight);
  head = rotatedAt(head, end, posture.headYaw, kUp);
  return {lower, upper, head};
}

/// Returns the matrix that moves a bone from its rest position, hanging down from `rest`, to the line between two
/// points.
Mat4 hungBetween(Vec3 rest, Vec3 from, Vec3 to, Vec3 forward, float size) {
  const Vec3 up = glm::normalize(from - to);
  const Vec3 right = glm::normalize(glm::cross(forward, up));
  const Vec3 back = glm::cross(right, up);
  Mat4 matrix(1.0F);
  matrix[0] = world::Vec4(right * size, 0.0F);
  matrix[1] = world::Vec4(up * size, 0.0F);
  matrix[2] = world::Vec4(back * size, 0.0F);
  matrix[3] = world::Vec4(from, 1.0F);
  return glm::translate(matrix, -rest);
}

LegBones scaled(const LegBones& bones, float size) {
  return {bones.upper * size, bones.lower * size, bones.cannon * size, bones.joint, bones.lean, bones.fold};
}

Vec3 headingOf(const AnimalPose& pose) { return {-std::sin(pose.yaw), 0.0F, -std::cos(pose.yaw)}; }

std::array<LegChain, kLegs> legsAt(const Trunk& trunk, const AnimalPose& pose, float size) {
  std::array<LegChain, kLegs> legs;
  const Vec3 heading = headingOf(pose);
  for (std::size_t i = 0; i < kLegs; ++i) {
    const auto leg = static_cast<Leg>(i);
    const bool isFore = leg == kLeftFore || leg == kRightFore;
    Vec3 root = Vec3((isFore ? trunk.chest : trunk.pelvis) * world::Vec4(legRoot(leg), 1.0F));
    if (isFore) {
      const float ahead = glm::dot(pose.feet[i] - root, heading);
      root += std::clamp(kBladeShare * ahead, -kBladeMost * size, kBladeMost * size) * heading;
    }
    legs[i] = placeLeg(scaled(legBones(leg), size), root, pose.feet[i], heading);
  }
  return legs;
}

}  // namespace

Posture mixed(const Posture& from, const Posture& to, float share) {
  const auto mix = [share](float a, float b) { return a + share * (b - a); };
  return {mix(from.rise, to.rise),           mix(from.pitch, to.pitch),
          mix(from.roll, to.roll),           mix(from.bend, to.bend),
          mix(from.neckPitch, to.neckPitch), mix(from.neckYaw, to.neckYaw),
          mix(from.headPitch, to.headPitch), mix(from.headYaw, to.headYaw),
          mix(from.tail, to.tail),           mix(from.ears, to.ears)};
}

AnimalPose mixed(const AnimalPose& from, const AnimalPose& to, float share) {
  AnimalPose pose;
  pose.place = from.place + share * (to.place - from.place);
  pose.yaw = from.yaw + share * std::remainder(to.yaw - from.yaw, kTurn);
  pose.posture = mixed(from.posture, to.posture, share);
  for (std::size_t i = 0; i < kLegs; ++i) pose.feet[i] = from.feet[i] + share * (to.feet[i] - from.feet[i]);
  return pose;
}

Vec3 legRoot(Leg leg) noexcept {
  const bool isFore = leg == kLeftFore || leg == kRightFore;
  const bool isLeft = leg == kLeftFore || leg == kLeftHind;
  return isFore ? Vec3(isLeft ? -0.085F : 0.085F, 0.745F, -0.31F) : Vec3(isLeft ? -0.085F : 0.085F, 0.83F, 0.33F);
}

const LegBones& legBones(Leg leg) noexcept { return leg == kLeftFore || leg == kRightFore ? kForeLeg : kHindLeg; }

std::array<Mat4, kBones> bonesOf(const AnimalPose& pose, float size) {
  const Trunk trunk = trunkOf(pose, size);
  const auto [lower, upper, head] = neckAndHead(trunk, pose);
  std::array<Mat4, kBones> bones;
  bones[kPelvis] = trunk.pelvis;
  bones[kChest] = trunk.chest;
  bones[kLowerNeck] = lower;
  bones[kUpperNeck] = upper;
  bones[kHead] = head;
  bones[kTail] = rotatedAt(trunk.pelvis, kTailRoot, 1.22F - 2.30F * pose.posture.tail, kRight);
  const Vec3 neckEnd = kNeckRoot - (kLowerNeckLength + kUpperNeckLength) * kBack;
  for (const float side : {-1.0F, 1.0F}) {
    const Vec3 root = neckEnd + Vec3(-side * kLeftEarRoot.x, kLeftEarRoot.y, kLeftEarRoot.z);
    // They stand out to the side, a little back; forward ears stand up.
    const float out = 1.15F - 0.45F * pose.posture.ears;
    Mat4 ear = rotatedAt(head, root, 0.25F - 0.35F * pose.posture.ears, kRight);
    ear = rotatedAt(ear, root, -side * out, kBack);
    bones[side < 0.0F ? kLeftEar : kRightEar] = ear;
  }
  const std::array<LegChain, kLegs> legs = legsAt(trunk, pose, size);
  const Vec3 heading = headingOf(pose);
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    Vec3 rest = legRoot(static_cast<Leg>(leg));
    const LegBones& lengths = legBones(static_cast<Leg>(leg));
    const std::array<float, 3> lengthOf{lengths.upper, lengths.lower, lengths.cannon};
    for (std::size_t part = 0; part < 3; ++part) {
      bones[kFirstLegBone + 3 * leg + part] = hungBetween(rest, legs[leg][part], legs[leg][part + 1], heading, size);
      rest.y -= lengthOf[part];
    }
  }
  return bones;
}

std::array<LegChain, kLegs> legsOf(const AnimalPose& pose, float size) {
  return legsAt(trunkOf(pose, size), pose, size);
}

}  // namespace grove::objects::herd
