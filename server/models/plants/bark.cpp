#include "models/plants/bark.h"

#include <algorithm>
#include <cmath>

#include "world/noise.h"

namespace grove::models {
namespace {

using world::Vec3;

/// 0 in furrows, 1 on ridges, from noise with features `across` and `along` metres long.
float ridges(const BarkPlace& place, float across, float along) {
  const Vec3 at = place.onLimb / Vec3(across, along, across);
  return std::min(1.0F, 3.2F * std::abs(world::fractalNoise(at + 40.0F, 3) - 0.5F));
}

float blotches(const BarkPlace& place, float size) { return world::fractalNoise(place.position / size + 90.0F, 3); }

/// Green growth at the foot and on the side away from the sun.
float moss(const BarkPlace& place) {
  const float foot = std::exp(-std::max(0.0F, place.position.y) / 0.55F);
  const float shade = std::max(0.0F, place.normal.z);
  return glm::smoothstep(0.45F, 0.75F, 0.8F * blotches(place, 0.12F) + 0.45F * foot + 0.15F * shade - 0.1F);
}

/// Relief and furrows fade on thin limbs.
float oldness(const BarkPlace& place) { return glm::smoothstep(0.015F, 0.12F, place.radius); }

}  // namespace

float rootFlare(const BarkPlace& place, int roots) {
  const float height = std::max(0.0F, place.position.y + 0.05F);
  const float turn = std::atan2(place.normal.z, place.normal.x);
  const float spread = 0.65F + 0.35F * std::sin(static_cast<float>(roots) * turn + 1.3F * std::sin(turn));
  return place.radius * 0.85F * spread * std::exp(-height / (1.6F * place.radius));
}

BarkLook oakBark(const BarkPlace& place) {
  const float old = oldness(place);
  const float ridge = ridges(place, 0.05F, 0.22F);
  const Vec3 grey = glm::mix(Vec3(1.0F, 0.9F, 0.78F), Vec3(1.05F, 1.05F, 1.0F), blotches(place, 0.4F));
  Vec3 colour = grey * glm::mix(0.85F, 0.35F + 0.95F * ridge, old);
  colour = glm::mix(colour, Vec3(0.75F, 1.0F, 0.35F), 0.7F * old * moss(place));
  return {colour, old * 0.1F * place.radius * (ridge - 0.5F) + (place.radius > 0.1F ? rootFlare(place, 5) : 0.0F)};
}

BarkLook birchBark(const BarkPlace& place) {
  const float old = glm::smoothstep(0.012F, 0.035F, place.radius);
  const Vec3 twig = Vec3(0.30F, 0.19F, 0.13F) * (0.8F + 0.4F * blotches(place, 0.1F));
  // Lenticels: short dark dashes around the stem; black furrowed diamonds where branches were, more at the foot.
  const Vec3 dashAt = place.onLimb / Vec3(0.09F, 0.013F, 0.09F);
  const float dashes = glm::smoothstep(0.66F, 0.74F, world::fractalNoise(dashAt + 7.0F, 2));
  const float foot = std::exp(-std::max(0.0F, place.position.y) / 0.5F);
  const float scar = world::fractalNoise(place.onLimb / Vec3(0.11F, 0.2F, 0.11F) + 60.0F, 3) + 0.33F * foot;
  const float scars = glm::smoothstep(0.62F, 0.68F, scar);
  const float chalk = 0.86F + 0.28F * blotches(place, 0.25F);
  Vec3 colour = Vec3(1.0F, 0.97F, 0.92F) * chalk;
  colour = glm::mix(colour, Vec3(0.36F, 0.30F, 0.26F), 0.85F * dashes);
  colour = glm::mix(colour, Vec3(0.13F, 0.11F, 0.10F), scars);
  const float relief = place.radius * 0.10F * (scars - 0.5F) * old;
  return {glm::mix(twig, colour, old), relief + (place.radius > 0.06F ? 0.8F * rootFlare(place, 4) : 0.0F)};
}

BarkLook spruceBark(const BarkPlace& place) {
  const float old = oldness(place);
  const float scales = ridges(place, 0.035F, 0.05F);
  const Vec3 base = glm::mix(Vec3(1.05F, 0.78F, 0.62F), Vec3(0.95F, 0.92F, 0.88F), blotches(place, 0.3F));
  Vec3 colour = base * glm::mix(0.75F, 0.45F + 0.8F * scales, old);
  colour = glm::mix(colour, Vec3(0.75F, 0.95F, 0.4F), 0.5F * old * moss(place));
  return {colour, old * 0.07F * place.radius * (scales - 0.5F) + (place.radius > 0.1F ? rootFlare(place, 5) : 0.0F)};
}

BarkLook pineBark(const BarkPlace& place) {
  const float old = oldness(place);
  const float plates = ridges(place, 0.06F, 0.11F);
  // Grey plates at the foot, thin orange bark above.
  const float high = glm::smoothstep(1.2F, 4.2F, place.position.y + 1.2F * (blotches(place, 0.5F) - 0.5F));
  const Vec3 foot = Vec3(0.62F, 0.50F, 0.44F) * (0.45F + 0.8F * plates);
  const Vec3 above = glm::mix(Vec3(1.25F, 0.66F, 0.36F), Vec3(1.05F, 0.52F, 0.26F), blotches(place, 0.12F));
  const Vec3 colour = glm::mix(foot, above * (0.8F + 0.3F * plates), high) * glm::mix(0.7F, 1.0F, old);
  const float relief = old * glm::mix(0.10F, 0.02F, high) * place.radius * (plates - 0.5F);
  return {colour, relief + (place.radius > 0.1F ? 0.7F * rootFlare(place, 5) : 0.0F)};
}

BarkLook stalkBark(const BarkPlace& place) { return {Vec3(0.8F + 0.4F * blotches(place, 0.05F)), 0.0F}; }

}  // namespace grove::models
