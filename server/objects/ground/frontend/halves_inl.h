// Full vectors of 16-bit numbers. For kernels: included once per target.

#if defined(GROVE_OBJECTS_GROUND_FRONTEND_HALVES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_GROUND_FRONTEND_HALVES_INL_H
#undef GROVE_OBJECTS_GROUND_FRONTEND_HALVES_INL_H
#else
#define GROVE_OBJECTS_GROUND_FRONTEND_HALVES_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "objects/ground/frontend/spread_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::ground::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using HalfTag = hn::ScalableTag<std::int16_t>;
using UnsignedHalfTag = hn::RebindToUnsigned<HalfTag>;
using Halves = hn::Vec<HalfTag>;
using UnsignedHalves = hn::Vec<UnsignedHalfTag>;
/// Vectors of pixels, with half as many lanes.
using PixelTag = hn::Repartition<std::uint32_t, HalfTag>;
using Pixels = hn::Vec<PixelTag>;

inline constexpr std::size_t kHalves = hn::MaxLanes(HalfTag());
inline constexpr std::size_t kPixels = hn::MaxLanes(PixelTag());
static_assert(kTile % kHalves == 0);

HWY_INLINE Halves halves(int value) { return hn::Set(HalfTag(), static_cast<std::int16_t>(value)); }
HWY_INLINE UnsignedHalves unsignedHalves(int value) {
  return hn::Set(UnsignedHalfTag(), static_cast<std::uint16_t>(value));
}

/// Looks up `kCount` texels one by one: measured no slower than a gather on AVX3, and faster on AVX2.
template <std::size_t kCount>
HWY_INLINE void lookUp(const std::uint32_t* HWY_RESTRICT texels, const std::int32_t* HWY_RESTRICT at,
                       std::uint32_t* HWY_RESTRICT out) {
  for (std::size_t i = 0; i < kCount; ++i) out[i] = texels[at[i]];
}

/// Height of the grass in one vector of columns from `first` on, a multiple of the vector's length.
HWY_INLINE Halves grassAt(const SoilBetween& soil, std::size_t first) {
  const HalfTag tag;
  const Halves step = hn::Load(tag, soil.step.grass.data() + first);
  return hn::Add(hn::Load(tag, soil.first.grass.data() + first), hn::Mul(step, halves(soil.steps)));
}

}  // namespace grove::objects::ground::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
