// Loads at the end of an array whose length is no multiple of the lanes. For kernels: included once per target.

#if defined(GROVE_OBJECTS_FLUID_COMMON_LOAD_PARTIAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_FLUID_COMMON_LOAD_PARTIAL_INL_H
#undef GROVE_OBJECTS_FLUID_COMMON_LOAD_PARTIAL_INL_H
#else
#define GROVE_OBJECTS_FLUID_COMMON_LOAD_PARTIAL_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

/// Loads the values from index i on, and zeros beyond the end.
HWY_INLINE simd::HWY_NAMESPACE::Floats loadPartial(const float* values, std::size_t i, std::size_t count) {
  using simd::HWY_NAMESPACE::kLanes;
  if (i + static_cast<std::size_t>(kLanes) <= count) return simd::HWY_NAMESPACE::load(values + i);
  alignas(64) float room[kLanes] = {};
  std::copy(values + i, values + count, room);
  return simd::HWY_NAMESPACE::load(room);
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
