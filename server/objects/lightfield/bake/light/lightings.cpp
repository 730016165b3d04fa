#include "objects/lightfield/bake/light/lightings.h"

#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace grove::bake {

using world::Vec3;

namespace {

Vec3 turned(Vec3 v, float cosine, float sine) noexcept {
  return {v.x * cosine + v.z * sine, v.y, v.z * cosine - v.x * sine};
}

}  // namespace

Lightings::Lightings(const world::Sky& sky, int count) : sky_(sky) {
  assert(count >= 1);
  for (int k = 0; k < count; ++k) {
    const float angle = glm::two_pi<float>() * static_cast<float>(k) / static_cast<float>(count);
    turns_.push_back({std::cos(angle), std::sin(angle)});
  }
}

float Lightings::firstAzimuth() const noexcept { return std::atan2(sky_.sun.x, sky_.sun.z); }

Vec3 Lightings::sun(int k) const noexcept {
  const Turn& turn = turns_[static_cast<std::size_t>(k)];
  return turned(sky_.sun, turn.cosine, turn.sine);
}

Vec3 Lightings::skyRadiance(int k, Vec3 direction) const noexcept {
  const Turn& turn = turns_[static_cast<std::size_t>(k)];
  return sky_.radiance(turned(direction, turn.cosine, -turn.sine));
}

Vec3 Lightings::ambient(int k, Vec3 normal) const noexcept {
  const Turn& turn = turns_[static_cast<std::size_t>(k)];
  return sky_.ambient(turned(normal, turn.cosine, -turn.sine));
}

Vec3 Lightings::meadowRadiance() const noexcept { return sky_.ambient({0.0F, -1.0F, 0.0F}); }

Vec3 Lightings::meadowAlbedo() const noexcept {
  const Vec3 up(0.0F, 1.0F, 0.0F);
  return meadowRadiance() / (sky_.ambient(up) + sky_.sunColour * sky_.sun.y);
}

}  // namespace grove::bake
