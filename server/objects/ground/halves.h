#pragma once

#include <cstdint>
#include <cstring>

#if defined(__AVX512BW__)
#include <immintrin.h>
#endif

/// Vectors of 16-bit numbers, which hold twice as many as those of floats, written with the compiler's vector types.
/// It finds them by itself too seldom: sums of products it would rather widen.
namespace grove::objects::ground {

inline constexpr int kHalves = __BIGGEST_ALIGNMENT__ >= 64 ? 32 : __BIGGEST_ALIGNMENT__ >= 32 ? 16 : 8;
using Halves [[gnu::vector_size(kHalves * 2)]] = std::int16_t;
using UnsignedHalves [[gnu::vector_size(kHalves * 2)]] = std::uint16_t;

/// Any kHalves * 2 bytes of memory, wherever they lie.
template <class Vector, class Element>
[[nodiscard]] inline Vector load(const Element* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof(vector));
  return vector;
}
template <class Vector, class Element>
inline void store(Vector vector, Element* to) {
  std::memcpy(to, &vector, sizeof(vector));
}

/// The upper halves of products.
#if defined(__AVX512BW__)
[[nodiscard]] inline Halves upper(Halves a, Halves b) {
  return reinterpret_cast<Halves>(_mm512_mulhi_epi16(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b)));
}
[[nodiscard]] inline UnsignedHalves upper(UnsignedHalves a, UnsignedHalves b) {
  return reinterpret_cast<UnsignedHalves>(
      _mm512_mulhi_epu16(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b)));
}
/// Of `a` so many 2^15ths, rounded.
[[nodiscard]] inline Halves part(Halves a, Halves b) {
  return reinterpret_cast<Halves>(_mm512_mulhrs_epi16(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b)));
}
#else
[[nodiscard]] inline Halves upper(Halves a, Halves b) {
  Halves result{};
  for (int i = 0; i < kHalves; ++i) result[i] = static_cast<std::int16_t>((a[i] * b[i]) >> 16);
  return result;
}
[[nodiscard]] inline UnsignedHalves upper(UnsignedHalves a, UnsignedHalves b) {
  UnsignedHalves result{};
  for (int i = 0; i < kHalves; ++i) {
    result[i] = static_cast<std::uint16_t>((std::uint32_t{a[i]} * std::uint32_t{b[i]}) >> 16U);
  }
  return result;
}
[[nodiscard]] inline Halves part(Halves a, Halves b) {
  Halves result{};
  for (int i = 0; i < kHalves; ++i) result[i] = static_cast<std::int16_t>((a[i] * b[i] + 0x4000) >> 15);
  return result;
}
#endif

[[nodiscard]] inline Halves least(Halves a, Halves b) { return a < b ? a : b; }
[[nodiscard]] inline Halves most(Halves a, Halves b) { return a > b ? a : b; }

}  // namespace grove::objects::ground
