// Min and max of two numbers. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_COMMON_LOWER_UPPER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_COMMON_LOWER_UPPER_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_COMMON_LOWER_UPPER_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_COMMON_LOWER_UPPER_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

// By value: references become pointers, which the compiler loads one by one.
HWY_INLINE float lower(float a, float b) { return a < b ? a : b; }
HWY_INLINE float upper(float a, float b) { return a > b ? a : b; }

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
