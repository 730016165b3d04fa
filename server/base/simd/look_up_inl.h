// Look-ups of memory by a vector of indices. For kernels: included once per target.
// By plain loads, four lanes at a time: a gather instruction was as fast as these, and is slower on processors whose
// microcode guards it.

#if defined(GROVE_BASE_SIMD_LOOK_UP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BASE_SIMD_LOOK_UP_INL_H
#undef GROVE_BASE_SIMD_LOOK_UP_INL_H
#else
#define GROVE_BASE_SIMD_LOOK_UP_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::simd::HWY_NAMESPACE {

/// Four lanes of `T`.
template <typename T>
using QuadTag = hn::FixedTag<T, 4>;

/// kLanes values, four at a time from quad(first lane).
template <typename T, typename MakeQuad>
HWY_INLINE auto joinQuads(const MakeQuad& quad) {
#if HWY_MAX_BYTES >= 64
  const hn::FixedTag<T, 8> half;
  return hn::Combine(hn::FixedTag<T, 16>(), hn::Combine(half, quad(12), quad(8)), hn::Combine(half, quad(4), quad(0)));
#elif HWY_MAX_BYTES >= 32
  return hn::Combine(hn::FixedTag<T, 8>(), quad(4), quad(0));
#else
  return quad(0);
#endif
}

/// The indices of a vector, one by one.
class Indices {
 public:
  HWY_INLINE explicit Indices(Ints at) { hn::Store(at.raw, IntTag(), at_); }
  HWY_INLINE std::ptrdiff_t operator[](int lane) const { return at_[lane]; }

 private:
  alignas(64) std::int32_t at_[kLanes];
};

/// base[at] to base[at + kCount - 1] of four lanes, from `lane` on.
template <std::size_t kCount, typename T>
HWY_INLINE auto loadFour(const T* base, const Indices& at, int lane) {
  const hn::FixedTag<T, kCount> one;
  const hn::FixedTag<T, 2 * kCount> two;
  const hn::FixedTag<T, 4 * kCount> four;
  const auto value = [&](int i) { return hn::LoadU(one, base + at[lane + i]); };
  return hn::Combine(four, hn::Combine(two, value(3), value(2)), hn::Combine(two, value(1), value(0)));
}

/// base[at] of each lane.
HWY_INLINE Floats lookUp(const float* base, Ints at) {
  const Indices indices(at);
  return joinQuads<float>([&](int lane) { return loadFour<1>(base, indices, lane); });
}
HWY_INLINE Ints lookUp(const std::uint32_t* base, Ints at) {
  const Indices indices(at);
  return hn::BitCast(IntTag(), joinQuads<std::uint32_t>([&](int lane) { return loadFour<1>(base, indices, lane); }));
}
HWY_INLINE Ints lookUp(const std::uint16_t* base, Ints at) {
  const Indices indices(at);
  return Ints(joinQuads<std::int32_t>(
      [&](int lane) { return hn::PromoteTo(QuadTag<std::int32_t>(), loadFour<1>(base, indices, lane)); }));
}

/// Two neighbours in memory for each lane.
struct Pair {
  Ints first;
  Ints second;
};

/// base[at] and base[at + 1] of each lane.
HWY_INLINE Pair lookUpPair(const std::uint32_t* base, Ints at) {
  const QuadTag<std::uint32_t> quad;
  const hn::FixedTag<std::uint32_t, 2> pair;
  const Indices indices(at);
  // The pairs of lanes i and i + 1.
  const auto two = [&](int i) {
    return hn::Combine(quad, hn::LoadU(pair, base + indices[i + 1]), hn::LoadU(pair, base + indices[i]));
  };
  const auto first = joinQuads<std::uint32_t>([&](int i) { return hn::ConcatEven(quad, two(i + 2), two(i)); });
  const auto second = joinQuads<std::uint32_t>([&](int i) { return hn::ConcatOdd(quad, two(i + 2), two(i)); });
  return {hn::BitCast(IntTag(), first), hn::BitCast(IntTag(), second)};
}

HWY_INLINE Pair lookUpPair(const std::uint16_t* base, Ints at) {
  const Indices indices(at);
  const Ints pairs(joinQuads<std::int32_t>(
      [&](int lane) { return hn::BitCast(QuadTag<std::int32_t>(), loadFour<2>(base, indices, lane)); }));
  return {pairs & 0xFFFF, shiftRight<16>(pairs)};
}

struct FloatPair {
  Floats first;
  Floats second;
};

HWY_INLINE FloatPair lookUpPair(const float* base, Ints at) { return {lookUp(base, at), lookUp(base + 1, at)}; }

}  // namespace grove::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
