#include "objects/herd/common/leg_chain.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::herd {
namespace {

using world::Vec3;

/// A leg is never quite straight: a straight one would snap.
constexpr float kLongest = 0.998F;

/// Returns the joint of two bones whose other ends are at `from` and `to`.
Vec3 middleJoint(Vec3 from, Vec3 to, float first, float second, Vec3 side) {
  const Vec3 way = to - from;
  const float distance = std::max(glm::length(way), 1.0e-4F);
  const Vec3 along = way / distance;
  const float reach = (first * first - second * second + distance * distance) / (2.0F * distance);
  const float out = std::sqrt(std::max(0.0F, first * first - reach * reach));
  const Vec3 across = side - glm::dot(side, along) * along;
  return from + reach * along + out * glm::normalize(across);
}

}  // namespace

LegChain placeLeg(const LegBones& bones, Vec3 joint, Vec3 foot, Vec3 forward) {
  Vec3 way = foot - joint;
  float distance = std::max(glm::length(way), 1.0e-4F);
  const Vec3 down = way / distance;
  const float longest = kLongest * bones.length();
  if (distance > longest) {
    distance = longest;
    foot = joint + distance * down;
  }
  const Vec3 ahead = glm::normalize(forward - glm::dot(forward, down) * down);
  const float shortening = 1.0F - distance / bones.length();
  const float reach = kLongest * (bones.upper + bones.lower);
  const float least = std::abs(bones.upper - bones.lower) / kLongest;
  // The more it leans, the farther its upper end is from the trunk: as far as the other two bones reach at most.
  const float cosine =
      (distance * distance + bones.cannon * bones.cannon - reach * reach) / (2.0F * distance * bones.cannon);
  const float most = std::acos(std::clamp(cosine, -1.0F, 1.0F));
  const float lean = std::clamp(bones.lean + bones.fold * shortening, -most, most);
  Vec3 hock = foot + bones.cannon * (ahead * std::sin(lean) - down * std::cos(lean));
  const float span = glm::distance(joint, hock);
  if (span > reach) hock = joint + (hock - joint) * (reach / span);
  if (span < least) hock = joint + (hock - joint) * (least / std::max(span, 1.0e-4F));
  return {joint, middleJoint(joint, hock, bones.upper, bones.lower, bones.joint * ahead), hock, foot};
}

}  // namespace grove::objects::herd
