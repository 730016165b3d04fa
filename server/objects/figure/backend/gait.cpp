#include "objects/figure/backend/gait.h"

#include <algorithm>
#include <cmath>

#include "objects/figure/backend/limbs.h"

namespace grove::objects::figure {
namespace {

using world::Mat4;
using world::Vec3;

constexpr float kSwing = 0.34F;  // amplitude of a leg at full speed, radians

/// Rotates about a sideways axis at this height.
Mat4 swung(const Mat4& body, float height, float angle) {
  const Vec3 pivot(0.0F, height, 0.0F);
  return glm::translate(glm::rotate(glm::translate(body, pivot), angle, Vec3(1, 0, 0)), -pivot);
}

}  // namespace

float paceOf(const world::Player& player) noexcept {
  return std::min(1.0F, std::hypot(player.velocity.x, player.velocity.z) / world::kWalkSpeed);
}

std::array<Mat4, kBones> bonesOf(const world::Player& player, const world::Transform& transform) {
  const float phase = player.stride * kTurn / kStrideMetres;
  const float pace = paceOf(player);
  const float swing = kSwing * pace * std::sin(phase);
  Mat4 body = transform.matrix();
  body = glm::translate(body, Vec3(0.0F, 0.025F * pace * std::abs(std::cos(phase)), 0.0F));
  // Sways from foot to foot and leans into the walk.
  body = glm::rotate(body, 0.035F * pace * std::sin(phase), Vec3(0, 0, 1));
  body = glm::rotate(body, -0.06F * pace, Vec3(1, 0, 0));
  return {body, swung(body, kHipHeight, swing), swung(body, kHipHeight, -swing),
          swung(body, kShoulderHeight, 0.25F * swing)};
}

}  // namespace grove::objects::figure
