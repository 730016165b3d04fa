#pragma once

#include <cstdint>
#include <cstring>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

/// Sixteen pixels at once, written with the compiler's vector types, which it cuts into what the machine has.
namespace grove::objects::mesh {

inline constexpr int kLanes = 16;

using Floats [[gnu::vector_size(kLanes * 4)]] = float;
/// Also masks: -1 is true, 0 is false.
using Ints [[gnu::vector_size(kLanes * 4)]] = std::int32_t;

inline Floats toFloats(Ints value) { return __builtin_convertvector(value, Floats); }
inline Ints truncated(Floats value) { return __builtin_convertvector(value, Ints); }
inline Floats clamped(Floats value, Floats low, Floats high) {
  const Floats held = value > low ? value : low;
  return held < high ? held : high;
}
inline Floats clamped(Floats value, float low, float high) { return clamped(value, low - Floats{}, high - Floats{}); }

inline constexpr Ints kUpwards = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

template <class Lanes, class T>
inline Lanes load(const T* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
template <class Lanes, class T>
inline void store(Lanes lanes, T* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}

/// Two neighbours in memory for each lane.
struct Pair {
  Ints first;
  Ints second;
};

inline Pair lookUpPair(const std::uint32_t* base, Ints at) {
#if defined(__AVX512F__)
  // A look-up costs by its elements, so one of both neighbours costs half of two. The masked forms have a source,
  // which keeps GCC 12 from warning of registers that are never set.
  const auto index = reinterpret_cast<__m512i>(at);
  const __m512i low = _mm512_mask_i32gather_epi64(_mm512_setzero_si512(), 0xFF,
                                                  _mm512_maskz_extracti64x4_epi64(0xF, index, 0), base, 4);
  const __m512i high = _mm512_mask_i32gather_epi64(_mm512_setzero_si512(), 0xFF,
                                                   _mm512_maskz_extracti64x4_epi64(0xF, index, 1), base, 4);
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
  return {reinterpret_cast<Ints>(_mm512_permutex2var_epi32(low, even, high)),
          reinterpret_cast<Ints>(_mm512_permutex2var_epi32(low, odd, high))};
#else
  Pair pair{};
  for (int i = 0; i < kLanes; ++i) {
    pair.first[i] = static_cast<std::int32_t>(base[at[i]]);
    pair.second[i] = static_cast<std::int32_t>(base[at[i] + 1]);
  }
  return pair;
#endif
}

}  // namespace grove::objects::mesh
