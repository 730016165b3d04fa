// The exponential function. For kernels: included once per target.

#if defined(GROVE_OBJECTS_FLUID_BACKEND_SIMULATION_EXPONENTIAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_FLUID_BACKEND_SIMULATION_EXPONENTIAL_INL_H
#undef GROVE_OBJECTS_FLUID_BACKEND_SIMULATION_EXPONENTIAL_INL_H
#else
#define GROVE_OBJECTS_FLUID_BACKEND_SIMULATION_EXPONENTIAL_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

HWY_INLINE simd::HWY_NAMESPACE::Floats exponential(simd::HWY_NAMESPACE::Floats power) {
  return hwy::HWY_NAMESPACE::Exp(simd::HWY_NAMESPACE::FloatTag(), power.raw);
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
