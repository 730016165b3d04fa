// Trilinear samples of a field at kLanes positions at once. For kernels: included once per target.

#if defined(GROVE_OBJECTS_FLUID_BACKEND_SIMULATION_TRILINEAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_FLUID_BACKEND_SIMULATION_TRILINEAR_INL_H
#undef GROVE_OBJECTS_FLUID_BACKEND_SIMULATION_TRILINEAR_INL_H
#else
#define GROVE_OBJECTS_FLUID_BACKEND_SIMULATION_TRILINEAR_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Pairs of adjacent values from two rows.
using SquareTag = hn::FixedTag<float, 4>;
using PairTag = hn::FixedTag<float, 2>;

HWY_INLINE hn::Vec<SquareTag> loadSquare(const float* row, const float* nextRow) {
  return hn::Combine(SquareTag(), hn::LoadU(PairTag(), nextRow), hn::LoadU(PairTag(), row));
}

/// Interpolates between the values at `corner` (indices into the field) and their upper neighbours with the shares
/// 0..1. Uses four loads of two values instead of gathers, which on all processors fetch the eight values of a position
/// one by one.
HWY_INLINE simd::HWY_NAMESPACE::Floats sampleTrilinear(const float* field, std::ptrdiff_t stride, std::ptrdiff_t plane,
                                                       simd::HWY_NAMESPACE::Ints corner,
                                                       simd::HWY_NAMESPACE::Floats shareX,
                                                       simd::HWY_NAMESPACE::Floats shareY,
                                                       simd::HWY_NAMESPACE::Floats shareZ) {
  using simd::HWY_NAMESPACE::FloatTag;
  using simd::HWY_NAMESPACE::kLanes;
  alignas(64) std::int32_t corners[kLanes];
  alignas(64) float shares[kLanes];
  alignas(64) float squares[4 * kLanes];
  store(corner, corners);
  store(shareZ, shares);
  for (int lane = 0; lane < kLanes; ++lane) {
    const float* const at = field + corners[lane];
    const auto low = loadSquare(at, at + stride);
    const auto high = loadSquare(at + plane, at + plane + stride);
    hn::Store(hn::MulAdd(hn::Set(SquareTag(), shares[lane]), hn::Sub(high, low), low), SquareTag(), squares + 4 * lane);
  }
  hn::Vec<FloatTag> a, b, c, d;
  hn::LoadInterleaved4(FloatTag(), squares, a, b, c, d);
  const auto near = hn::MulAdd(shareX.raw, hn::Sub(b, a), a);
  const auto far = hn::MulAdd(shareX.raw, hn::Sub(d, c), c);
  return hn::MulAdd(shareY.raw, hn::Sub(far, near), near);
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
