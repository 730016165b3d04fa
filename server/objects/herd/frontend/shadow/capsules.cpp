#include "objects/herd/frontend/shadow/capsules.h"

namespace grove::objects::herd {
namespace {

using world::Vec3;

Vec3 at(const world::Mat4& bone, Vec3 point) { return Vec3(bone * world::Vec4(point, 1.0F)); }

constexpr std::array<float, 4> kForeRadii{0.055F, 0.035F, 0.020F, 0.020F};
constexpr std::array<float, 4> kHindRadii{0.095F, 0.045F, 0.022F, 0.020F};

}  // namespace

Capsules capsulesOf(const AnimalPose& pose, float size, bool hasAntlers) {
  const auto bones = bonesOf(pose, size);
  const Vec3 lower = kNeckRoot + Vec3(0.0F, -0.05F, 0.0F);
  const Vec3 upper = kNeckRoot - Vec3(0.0F, 0.0F, kLowerNeckLength);
  const Vec3 end = upper - Vec3(0.0F, 0.0F, kUpperNeckLength);
  Capsules all{{
      {at(bones[kPelvis], {0.0F, 0.77F, 0.38F}), at(bones[kPelvis], {0.0F, 0.72F, 0.0F}), 0.125F, 0.18F},
      {at(bones[kChest], {0.0F, 0.72F, 0.0F}), at(bones[kChest], {0.0F, 0.73F, -0.32F}), 0.18F, 0.16F},
      {at(bones[kLowerNeck], lower), at(bones[kLowerNeck], upper), 0.10F, 0.065F},
      {at(bones[kUpperNeck], upper), at(bones[kUpperNeck], end), 0.065F, 0.055F},
      {at(bones[kHead], end), at(bones[kHead], end - Vec3(0.0F, 0.01F, 0.23F)), 0.06F, 0.03F},
  }};
  const std::array<LegChain, kLegs> legs = legsOf(pose, size);
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    const auto& radii = leg == kLeftFore || leg == kRightFore ? kForeRadii : kHindRadii;
    for (std::size_t part = 0; part < 3; ++part) {
      all[kHeadCapsule + 1 + 3 * leg + part] = {legs[leg][part], legs[leg][part + 1], radii[part], radii[part + 1]};
    }
  }
  for (const float side : {-1.0F, 1.0F}) {
    Capsule& antler = all[side < 0.0F ? kCapsules - 2 : kCapsules - 1];
    antler.from = antler.to = at(bones[kHead], end);
    if (!hasAntlers) continue;
    antler = {at(bones[kHead], end + Vec3(side * 0.12F, 0.14F, 0.06F)),
              at(bones[kHead], end + Vec3(side * 0.20F, 0.40F, 0.08F)), 0.03F, 0.09F};
  }
  for (Capsule& each : all) {
    each.fromRadius *= size;
    each.toRadius *= size;
  }
  return all;
}

}  // namespace grove::objects::herd
