#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

/// As many pixels at once as the machine's registers hold, written with the compiler's vector types. Only what these
/// cannot say (looking up memory, reducing to one number) is spelled out for AVX-512, with a plain loop for others.
namespace grove::objects::lightfield::simd {

inline constexpr int kLanes = __BIGGEST_ALIGNMENT__ >= 64 ? 16 : __BIGGEST_ALIGNMENT__ >= 32 ? 8 : 4;

using Floats [[gnu::vector_size(kLanes * 4)]] = float;
/// Also masks: -1 is true, 0 is false.
using Ints [[gnu::vector_size(kLanes * 4)]] = std::int32_t;

inline Floats all(float value) { return value - Floats{}; }
inline Floats toFloats(Ints value) { return __builtin_convertvector(value, Floats); }
inline Ints truncated(Floats value) { return __builtin_convertvector(value, Ints); }
inline Ints floored(Floats value) {
  const Ints cut = truncated(value);
  return cut + (value < toFloats(cut));
}
inline Floats least(Floats a, Floats b) { return a < b ? a : b; }
inline Floats most(Floats a, Floats b) { return a > b ? a : b; }
inline Floats clamped(Floats value, Floats low, Floats high) { return least(most(value, low), high); }
inline Floats absolute(Floats value) { return most(value, -value); }

inline Floats load(const float* from) {
  Floats value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
inline Ints load(const std::uint32_t* from) {
  Ints value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
inline void store(Floats value, float* to) { std::memcpy(to, &value, sizeof value); }
inline void store(Ints value, std::uint32_t* to) { std::memcpy(to, &value, sizeof value); }

inline Floats lanesUpwards() {
  Floats lanes{};
  for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<float>(i);
  return lanes;
}

inline float leastOf(Floats value) {
  const Ints lanes = truncated(lanesUpwards());
  for (int apart = kLanes / 2; apart > 0; apart /= 2) value = least(value, __builtin_shuffle(value, lanes ^ apart));
  return value[0];
}
inline float mostOf(Floats value) { return -leastOf(-value); }

/// Two neighbours in memory for each lane.
struct Pair {
  Ints first;
  Ints second;
};

#if defined(__AVX512F__)

/// One bit a lane, as the machine compares and selects: for loops that would lose time with masks of whole lanes.
using Mask = __mmask16;
inline Mask maskOf(Ints mask) {
  return _mm512_test_epi32_mask(reinterpret_cast<__m512i>(mask), reinterpret_cast<__m512i>(mask));
}
inline Ints lanesOf(Mask mask) { return reinterpret_cast<Ints>(_mm512_maskz_set1_epi32(mask, -1)); }
inline bool any(Mask mask) { return mask != 0; }
inline Mask isBelow(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
inline Mask isAtMost(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
inline Floats select(Mask mask, Floats a, Floats b) { return _mm512_mask_mov_ps(b, mask, a); }
inline Floats onlyWhere(Mask mask, Floats value) { return _mm512_maskz_mov_ps(mask, value); }

inline bool any(Ints mask) {
  return _mm512_test_epi32_mask(reinterpret_cast<__m512i>(mask), reinterpret_cast<__m512i>(mask)) != 0;
}
inline Floats squareRoot(Floats value) { return _mm512_maskz_sqrt_ps(0xFFFF, value); }

// The masked forms have a source, which keeps GCC 12 from warning of registers that are never set.
inline Pair lookUpPair(const std::uint16_t* base, Ints at) {
  const auto both = reinterpret_cast<Ints>(
      _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xFFFF, reinterpret_cast<__m512i>(at), base, 2));
  return {both & 0xFFFF, (both >> 16) & 0xFFFF};
}
inline Pair lookUpPair(const std::uint32_t* base, Ints at) {
  const auto index = reinterpret_cast<__m512i>(at);
  const __m512i low = _mm512_mask_i32gather_epi64(_mm512_setzero_si512(), 0xFF,
                                                  _mm512_maskz_extracti64x4_epi64(0xF, index, 0), base, 4);
  const __m512i high = _mm512_mask_i32gather_epi64(_mm512_setzero_si512(), 0xFF,
                                                   _mm512_maskz_extracti64x4_epi64(0xF, index, 1), base, 4);
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
  return {reinterpret_cast<Ints>(_mm512_permutex2var_epi32(low, even, high)),
          reinterpret_cast<Ints>(_mm512_permutex2var_epi32(low, odd, high))};
}

inline Floats lookUp(const float* base, Ints at) {
  return _mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xFFFF, reinterpret_cast<__m512i>(at), base, 4);
}

#else

using Mask = Ints;
inline Mask maskOf(Ints mask) { return mask; }
inline Ints lanesOf(Mask mask) { return mask; }
inline Mask isBelow(Floats a, Floats b) { return a < b; }
inline Mask isAtMost(Floats a, Floats b) { return a <= b; }
inline Floats select(Mask mask, Floats a, Floats b) { return mask ? a : b; }
inline Floats onlyWhere(Mask mask, Floats value) { return mask ? value : Floats{}; }

inline Floats lookUp(const float* base, Ints at) {
  Floats result{};
  for (int i = 0; i < kLanes; ++i) result[i] = base[at[i]];
  return result;
}

inline bool any(Ints mask) {
  std::int32_t seen = 0;
  for (int i = 0; i < kLanes; ++i) seen |= mask[i];
  return seen != 0;
}
inline Floats squareRoot(Floats value) {
  Floats result{};
  for (int i = 0; i < kLanes; ++i) result[i] = std::sqrt(value[i]);
  return result;
}
template <typename Texel>
inline Pair lookUpPair(const Texel* base, Ints at) {
  Pair pair{};
  for (int i = 0; i < kLanes; ++i) {
    pair.first[i] = static_cast<std::int32_t>(base[at[i]]);
    pair.second[i] = static_cast<std::int32_t>(base[at[i] + 1]);
  }
  return pair;
}

#endif

}  // namespace grove::objects::lightfield::simd
