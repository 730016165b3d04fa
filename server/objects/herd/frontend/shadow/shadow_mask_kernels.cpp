#include "objects/herd/frontend/shadow/shadow_mask_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/herd/frontend/shadow/shadow_mask_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the line that includes this file once per target.
#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::herd::HWY_NAMESPACE {
namespace {

namespace lanes = grove::simd::HWY_NAMESPACE;
using lanes::Floats;
using lanes::Ints;
using lanes::kLanes;

static_assert(kMaskSide % kLanes == 0);

HWY_INLINE int texelOf(float place) { return static_cast<int>(std::clamp(place, 0.0F, kMaskSide - 1.0F)); }

void coverCapsule(const FlatCapsule& capsule, float* cover) {
  const world::Vec2 from = capsule.from;
  const world::Vec2 way = capsule.way;
  const float margin = std::max(capsule.fromRadius, capsule.toRadius) + capsule.soft;
  const int bottom = texelOf(std::max(from.y, from.y + way.y) + margin);
  const int right = texelOf(std::max(from.x, from.x + way.x) + margin);
  const int left = texelOf(std::min(from.x, from.x + way.x) - margin) / kLanes * kLanes;
  const float perSquare = 1.0F / std::max(way.x * way.x + way.y * way.y, 1.0e-6F);
  const Floats perSoft(0.5F / capsule.soft);
  const Floats wider(capsule.toRadius - capsule.fromRadius);
  for (int y = texelOf(std::min(from.y, from.y + way.y) - margin); y <= bottom; ++y) {
    const float offY = static_cast<float>(y) - from.y;
    for (int x = left; x <= right; x += kLanes) {
      const Floats offX = lanes::toFloats(lanes::upwards() + Ints(x)) - Floats(from.x);
      const Floats along = lanes::mulAdd(offX, way.x, offY * way.y) * Floats(perSquare);
      const Floats share = lanes::clamp(along, 0.0F, 1.0F);
      const Floats asideX = offX - share * Floats(way.x);
      const Floats asideY = Floats(offY) - share * Floats(way.y);
      const Floats inside =
          lanes::mulAdd(share, wider, capsule.fromRadius) - lanes::sqrt(lanes::mulAdd(asideX, asideX, asideY * asideY));
      const Floats covered = lanes::min(lanes::mulAdd(inside, perSoft, 0.5F), 1.0F);
      float* const out = cover + (y * kMaskSide + x);
      lanes::store(lanes::max(lanes::load(out), covered), out);
    }
  }
}

void packFours(const float* cover, std::uint32_t* fours) {
  const auto bytes = [](const float* from) { return lanes::truncate(lanes::load(from) * Floats(255.0F)); };
  for (int y = 0; y < kMaskSide; ++y) {
    for (int x = 0; x < kMaskSide; x += kLanes) {
      const float* const from = cover + (y * kMaskSide + x);
      const Ints row = bytes(from) | lanes::shiftLeft<8>(bytes(from + 1));
      const Ints below = bytes(from + kMaskSide) | lanes::shiftLeft<8>(bytes(from + kMaskSide + 1));
      lanes::store(row | lanes::shiftLeft<16>(below), fours + (y * kMaskSide + x));
    }
  }
}

}  // namespace
}  // namespace grove::objects::herd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::herd {

HWY_EXPORT(coverCapsule);
HWY_EXPORT(packFours);

void coverCapsule(const FlatCapsule& capsule, float* cover) { HWY_DYNAMIC_DISPATCH(coverCapsule)(capsule, cover); }

void packFours(const float* cover, std::uint32_t* fours) { HWY_DYNAMIC_DISPATCH(packFours)(cover, fours); }

}  // namespace grove::objects::herd

#endif  // HWY_ONCE
