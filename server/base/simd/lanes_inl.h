// Vectors as wide as the target's registers, at most 16 lanes. For kernels: included once per target, after
// <hwy/highway.h>. Wraps only operations in use; kernels reach the others of Highway through `.raw`.

#if defined(GROVE_BASE_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BASE_SIMD_LANES_INL_H
#undef GROVE_BASE_SIMD_LANES_INL_H
#else
#define GROVE_BASE_SIMD_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace grove::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

struct Floats {
  hn::Vec<FloatTag> raw;

  Floats() : raw(hn::Zero(FloatTag())) {}
  Floats(hn::Vec<FloatTag> value) : raw(value) {}           // NOLINT(google-explicit-constructor)
  Floats(float value) : raw(hn::Set(FloatTag(), value)) {}  // NOLINT(google-explicit-constructor)
};

struct Ints {
  hn::Vec<IntTag> raw;

  Ints() : raw(hn::Zero(IntTag())) {}
  Ints(hn::Vec<IntTag> value) : raw(value) {}                  // NOLINT(google-explicit-constructor)
  Ints(std::int32_t value) : raw(hn::Set(IntTag(), value)) {}  // NOLINT(google-explicit-constructor)
};

/// True or false in each lane. One mask serves both kinds of lanes.
struct Mask {
  hn::Mask<FloatTag> raw;

  Mask() : raw(hn::MaskFromVec(hn::Zero(FloatTag()))) {}
  Mask(hn::Mask<FloatTag> value) : raw(value) {}  // NOLINT(google-explicit-constructor)
};

// Free functions, not friends: GCC 12 does not compile friends for the target.

HWY_INLINE Floats operator+(Floats a, Floats b) { return hn::Add(a.raw, b.raw); }
HWY_INLINE Floats operator-(Floats a, Floats b) { return hn::Sub(a.raw, b.raw); }
HWY_INLINE Floats operator*(Floats a, Floats b) { return hn::Mul(a.raw, b.raw); }
HWY_INLINE Floats operator/(Floats a, Floats b) { return hn::Div(a.raw, b.raw); }
HWY_INLINE Floats operator-(Floats a) { return hn::Neg(a.raw); }
HWY_INLINE Floats& operator+=(Floats& a, Floats b) { return a = a + b; }
HWY_INLINE Floats& operator-=(Floats& a, Floats b) { return a = a - b; }
HWY_INLINE Floats& operator*=(Floats& a, Floats b) { return a = a * b; }

HWY_INLINE Ints operator+(Ints a, Ints b) { return hn::Add(a.raw, b.raw); }
HWY_INLINE Ints operator-(Ints a, Ints b) { return hn::Sub(a.raw, b.raw); }
HWY_INLINE Ints operator*(Ints a, Ints b) { return hn::Mul(a.raw, b.raw); }
HWY_INLINE Ints operator&(Ints a, Ints b) { return hn::And(a.raw, b.raw); }
HWY_INLINE Ints operator|(Ints a, Ints b) { return hn::Or(a.raw, b.raw); }
template <int kBits>
HWY_INLINE Ints shiftLeft(Ints a) {
  return hn::ShiftLeft<kBits>(a.raw);
}
/// Fills with zeros.
template <int kBits>
HWY_INLINE Ints shiftRight(Ints a) {
  const hn::RebindToUnsigned<IntTag> bits;
  return hn::BitCast(IntTag(), hn::ShiftRight<kBits>(hn::BitCast(bits, a.raw)));
}

HWY_INLINE Mask operator<(Floats a, Floats b) { return hn::Lt(a.raw, b.raw); }
HWY_INLINE Mask operator<=(Floats a, Floats b) { return hn::Le(a.raw, b.raw); }
HWY_INLINE Mask operator>(Floats a, Floats b) { return hn::Gt(a.raw, b.raw); }
HWY_INLINE Mask operator>=(Floats a, Floats b) { return hn::Ge(a.raw, b.raw); }
HWY_INLINE Mask operator<(Ints a, Ints b) { return hn::RebindMask(FloatTag(), hn::Lt(a.raw, b.raw)); }
HWY_INLINE Mask operator>(Ints a, Ints b) { return hn::RebindMask(FloatTag(), hn::Gt(a.raw, b.raw)); }
HWY_INLINE Mask operator==(Ints a, Ints b) { return hn::RebindMask(FloatTag(), hn::Eq(a.raw, b.raw)); }
HWY_INLINE Mask operator!=(Ints a, Ints b) { return hn::RebindMask(FloatTag(), hn::Ne(a.raw, b.raw)); }

HWY_INLINE Mask operator&(Mask a, Mask b) { return hn::And(a.raw, b.raw); }
HWY_INLINE Mask operator|(Mask a, Mask b) { return hn::Or(a.raw, b.raw); }
HWY_INLINE Mask& operator&=(Mask& a, Mask b) { return a = a & b; }
HWY_INLINE Mask& operator|=(Mask& a, Mask b) { return a = a | b; }
/// a and not b.
HWY_INLINE Mask without(Mask a, Mask b) { return hn::AndNot(b.raw, a.raw); }
HWY_INLINE bool any(Mask mask) { return !hn::AllFalse(FloatTag(), mask.raw); }
HWY_INLINE bool all(Mask mask) { return hn::AllTrue(FloatTag(), mask.raw); }

HWY_INLINE Floats select(Mask mask, Floats a, Floats b) { return hn::IfThenElse(mask.raw, a.raw, b.raw); }
HWY_INLINE Floats onlyWhere(Mask mask, Floats value) { return hn::IfThenElseZero(mask.raw, value.raw); }
HWY_INLINE Ints select(Mask mask, Ints a, Ints b) {
  return hn::IfThenElse(hn::RebindMask(IntTag(), mask.raw), a.raw, b.raw);
}
HWY_INLINE Ints onlyWhere(Mask mask, Ints value) {
  return hn::IfThenElseZero(hn::RebindMask(IntTag(), mask.raw), value.raw);
}

HWY_INLINE Floats min(Floats a, Floats b) { return hn::Min(a.raw, b.raw); }
HWY_INLINE Floats max(Floats a, Floats b) { return hn::Max(a.raw, b.raw); }
HWY_INLINE Floats clamp(Floats value, Floats low, Floats high) { return min(max(value, low), high); }
HWY_INLINE Floats abs(Floats value) { return hn::Abs(value.raw); }
HWY_INLINE Floats sqrt(Floats value) { return hn::Sqrt(value.raw); }
HWY_INLINE Floats floor(Floats value) { return hn::Floor(value.raw); }
/// a * b + c, in one rounding where the target can.
HWY_INLINE Floats mulAdd(Floats a, Floats b, Floats c) { return hn::MulAdd(a.raw, b.raw, c.raw); }
HWY_INLINE Ints min(Ints a, Ints b) { return hn::Min(a.raw, b.raw); }
HWY_INLINE Ints max(Ints a, Ints b) { return hn::Max(a.raw, b.raw); }

HWY_INLINE Floats toFloats(Ints value) { return hn::ConvertTo(FloatTag(), value.raw); }
/// Rounds towards zero. Values outside of int become some int. (Highway 1.0 adds six instructions that make it the
/// nearest.)
HWY_INLINE Ints truncate(Floats value) {
#if HWY_TARGET == HWY_AVX3
  return hn::Vec<IntTag>{_mm512_cvttps_epi32(value.raw.raw)};
#elif HWY_TARGET == HWY_AVX2
  return hn::Vec<IntTag>{_mm256_cvttps_epi32(value.raw.raw)};
#elif HWY_TARGET == HWY_SSE4
  return hn::Vec<IntTag>{_mm_cvttps_epi32(value.raw.raw)};
#else
  return hn::ConvertTo(IntTag(), value.raw);
#endif
}
HWY_INLINE Ints floorToInts(Floats value) { return truncate(floor(value)); }

HWY_INLINE float minOf(Floats value) { return hn::GetLane(hn::MinOfLanes(FloatTag(), value.raw)); }
HWY_INLINE float maxOf(Floats value) { return hn::GetLane(hn::MaxOfLanes(FloatTag(), value.raw)); }
HWY_INLINE float sumOf(Floats value) { return hn::GetLane(hn::SumOfLanes(FloatTag(), value.raw)); }
HWY_INLINE std::int32_t maxOf(Ints value) { return hn::GetLane(hn::MaxOfLanes(IntTag(), value.raw)); }

/// 0, 1, 2, ...
HWY_INLINE Ints upwards() { return hn::Iota(IntTag(), 0); }

HWY_INLINE Floats load(const float* from) { return hn::LoadU(FloatTag(), from); }
HWY_INLINE Ints load(const std::int32_t* from) { return hn::LoadU(IntTag(), from); }
HWY_INLINE Ints load(const std::uint32_t* from) {
  return hn::BitCast(IntTag(), hn::LoadU(hn::RebindToUnsigned<IntTag>(), from));
}
HWY_INLINE void store(Floats value, float* to) { hn::StoreU(value.raw, FloatTag(), to); }
HWY_INLINE void store(Ints value, std::int32_t* to) { hn::StoreU(value.raw, IntTag(), to); }
HWY_INLINE void store(Ints value, std::uint32_t* to) {
  const hn::RebindToUnsigned<IntTag> bits;
  hn::StoreU(hn::BitCast(bits, value.raw), bits, to);
}

}  // namespace grove::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
