#include "objects/fluid/backend/solver/forces/forces_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/backend/solver/forces/forces_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

HWY_INLINE void pushAcross(float keep, float push, float* __restrict faces, int length) {
  for (int i = 0; i < length; ++i) faces[i] = keep * faces[i] + push;
}

HWY_INLINE void pushUp(float keep, float push, const float* __restrict sine, float lift, const float* __restrict above,
                       const float* __restrict below, float* __restrict faces, int length) {
  for (int i = 0; i < length; ++i) faces[i] = keep * faces[i] + push + sine[i] + lift * (above[i] + below[i]);
}

HWY_INLINE void pushAlong(float keep, float push, const float* __restrict cosine, float* __restrict faces, int length) {
  for (int i = 0; i < length; ++i) faces[i] = keep * faces[i] + push + cosine[i];
}

void pushPlane(const Layout& layout, int z, const WindPush& push, const float* temperature,
               const VelocityPointers& velocity) {
  const int n = layout.cells;
  for (int y = 0; y <= n; ++y) {
    const std::ptrdiff_t at = layout.index(0, y, z);
    if (y < n && z < n) {
      pushAcross(push.keep, push.steady[0] + push.sine[2][z] + push.cosine[1][y], velocity.x + at, n + 1);
    }
    if (z < n) {
      pushUp(push.keep, push.steady[1] + push.cosine[2][z], push.sine[0], push.lift, temperature + at,
             temperature + at - layout.stride, velocity.y + at, n);
    }
    if (y < n) pushAlong(push.keep, push.steady[2] + push.sine[1][y], push.cosine[0], velocity.z + at, n);
  }
}

HWY_INLINE void blowRow(float firstX, float cellSize, float directionX, float alongYz, float squaredYz, float perReach,
                        float fullTarget, float* __restrict faces, int n) {
  constexpr float kMouth = 0.25F;   // radius at the origin, metres
  constexpr float kSpread = 0.22F;  // growth of the radius per metre
  constexpr float kGain = 0.4F;     // share of the difference that one tick applies
  for (int x = 0; x < n; ++x) {
    const float px = static_cast<float>(x) * cellSize + firstX;
    const float along = px * directionX + alongYz;
    const float aside = px * px + squaredYz - along * along;
    const float ahead = along > 0.0F ? along : 0.0F;
    const float radius = kMouth + kSpread * ahead;
    const float across = 2.0F - 2.0F * aside / (radius * radius);
    const float inside = across > 0.0F ? (across < 1.0F ? across : 1.0F) : 0.0F;
    const float left = 1.0F - ahead * perReach;
    const float strength = along > 0.0F ? kGain * inside : 0.0F;
    const float target = fullTarget * (left > 0.0F ? left : 0.0F);
    const float lacking = target - faces[x];
    // Never slows down air that already moves faster in that direction.
    faces[x] += lacking * target > 0.0F ? strength * lacking : 0.0F;
  }
}

void blowPlane(const Layout& layout, int z, int axis, const GustCone& gust, float cellSize, float* faces) {
  const float offset[3] = {axis == 0 ? 0.0F : 0.5F, axis == 1 ? 0.0F : 0.5F, axis == 2 ? 0.0F : 0.5F};
  const float pz = (static_cast<float>(z) + offset[2]) * cellSize - gust.origin[2];
  for (int y = 0; y < layout.cells; ++y) {
    const float py = (static_cast<float>(y) + offset[1]) * cellSize - gust.origin[1];
    blowRow(offset[0] * cellSize - gust.origin[0], cellSize, gust.direction[0],
            py * gust.direction[1] + pz * gust.direction[2], py * py + pz * pz, 1.0F / gust.reach,
            gust.direction[axis] * gust.speed, faces + layout.index(0, y, z), layout.cells);
  }
}

HWY_INLINE void coolRow(float seconds, float* __restrict t, int n) {
  constexpr float kRadiation = 1.6F;  // per second at temperature 1, falls with its cube
  constexpr float kMixing = 0.28F;    // per second
  // smaller values would fade into denormal numbers, which halve the speed of a step
  constexpr float kNothing = 1.0e-6F;
  for (int i = 0; i < n; ++i) {
    const float loss = seconds * (kMixing + kRadiation * t[i] * t[i] * t[i]);
    const float cooled = t[i] / (1.0F + loss);
    t[i] = cooled > kNothing ? cooled : 0.0F;
  }
}

void coolPlane(const Layout& layout, int z, float seconds, float* temperature) {
  for (int y = 0; y < layout.cells; ++y) coolRow(seconds, temperature + layout.index(0, y, z), layout.cells);
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(pushPlane);
HWY_EXPORT(blowPlane);
HWY_EXPORT(coolPlane);

void pushPlane(const Layout& layout, int z, const WindPush& push, const float* temperature,
               const VelocityPointers& velocity) {
  HWY_DYNAMIC_DISPATCH(pushPlane)(layout, z, push, temperature, velocity);
}

void blowPlane(const Layout& layout, int z, int axis, const GustCone& gust, float cellSize, float* faces) {
  HWY_DYNAMIC_DISPATCH(blowPlane)(layout, z, axis, gust, cellSize, faces);
}

void coolPlane(const Layout& layout, int z, float seconds, float* temperature) {
  HWY_DYNAMIC_DISPATCH(coolPlane)(layout, z, seconds, temperature);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
