#include "objects/herd/backend/motion/gait.h"

#include <algorithm>

#include "world/geometry.h"

namespace grove::objects::herd {
namespace {

/// Offsets are those of Leg: left fore, right fore, left hind, right hind.
constexpr Gait kWalk{1.0F, 0.64F, {0.25F, 0.75F, 0.0F, 0.5F}, 0.09F, 0.008F, 0.012F, 0.0F, 0.62F, 0.05F, 0.05F};
constexpr Gait kTrot{1.8F, 0.46F, {0.5F, 1.0F, 0.0F, 0.5F}, 0.15F, 0.022F, 0.01F, 0.0F, 0.85F, 0.02F, 0.25F};
constexpr Gait kGallop{2.4F, 0.27F, {0.52F, 0.64F, 0.0F, 0.14F}, 0.20F, 0.055F, 0.13F, 1.0F, 0.62F, 0.10F, 0.85F};

Gait mixed(const Gait& from, const Gait& to, float share) {
  const auto mix = [share](float a, float b) { return a + share * (b - a); };
  Gait gait;
  gait.strides = mix(from.strides, to.strides);
  gait.duty = mix(from.duty, to.duty);
  for (std::size_t leg = 0; leg < kLegs; ++leg) gait.offsets[leg] = mix(from.offsets[leg], to.offsets[leg]);
  gait.lift = mix(from.lift, to.lift);
  gait.bounce = mix(from.bounce, to.bounce);
  gait.rock = mix(from.rock, to.rock);
  gait.leaps = mix(from.leaps, to.leaps);
  gait.neck = mix(from.neck, to.neck);
  gait.nod = mix(from.nod, to.nod);
  gait.tail = mix(from.tail, to.tail);
  return gait;
}

}  // namespace

Gait gaitAt(float speed) noexcept {
  Gait gait = speed < 3.0F ? mixed(kWalk, kTrot, glm::smoothstep(1.5F, 2.1F, speed))
                           : mixed(kTrot, kGallop, glm::smoothstep(3.6F, 4.4F, speed));
  // Longer strides rather than more of them.
  if (speed < 1.5F) gait.strides = 0.75F + 0.28F * speed;
  if (speed > 4.4F) gait.strides = 2.4F + 0.12F * (std::min(speed, 8.0F) - 5.0F);
  return gait;
}

}  // namespace grove::objects::herd
