#pragma once

#ifdef __AVX512FP16__
#include <immintrin.h>
#endif

#include <algorithm>

#include "objects/fluid/grid.h"

namespace grove::objects::fluid {

/// Numbers of 11 significant bits where the processor computes with them, which doubles what a vector holds and halves
/// what has to be fetched; elsewhere plain floats. For corrections and small neighbourhoods, never for a result that
/// builds up over time. Largest value 65504.
#ifdef __AVX512FP16__
using Half = _Float16;
#else
using Half = float;
#endif
using HalfField = Array<Half>;

/// Values of a whole vector; rows of halves are worked on in multiples of it, their ghosts being zero.
inline constexpr int kHalfLanes = 64 / static_cast<int>(sizeof(Half));
[[nodiscard]] constexpr int wholeHalfVectors(int n) noexcept { return (n + kHalfLanes - 1) / kHalfLanes * kHalfLanes; }

/// How planes of halves lie: densely, the ghosts of neighbouring rows shared, so that a stencil runs over a plane in
/// one long loop. It writes the ghosts too, whose values must therefore come out right or not matter.
struct PackedPlane {
  /// `ghosts` are those of a row, and of a column: one below 0, the others above.
  PackedPlane(int cells, int ghosts)
      : step(cells + ghosts),
        lead(2 * kHalfLanes - step % kHalfLanes),
        size(wholeHalfVectors(lead + step * step) + 3 * kHalfLanes) {}
  /// First value of a row.
  [[nodiscard]] std::ptrdiff_t row(int y) const noexcept { return lead + std::ptrdiff_t{step} * (y + 1); }

  int step;  ///< between rows
  int lead;  ///< ahead of the ghost row; row 0 begins a vector
  int size;  ///< of a plane, whole vectors
};

/// out = scale * in, held within +-16000, so that sums of four are finite.
inline void toHalf(const float* in, float scale, Half* out, int n) {
  constexpr float kMost = 16000.0F;
#ifdef __AVX512FP16__
  // GCC 12 does not vectorise conversions of this type by itself.
  const __m512 by = _mm512_set1_ps(scale);
  const __m512 high = _mm512_set1_ps(kMost);
  const __m512 low = _mm512_set1_ps(-kMost);
  for (int i = 0; i < n; i += 16) {
    const __mmask16 some = n - i >= 16 ? 0xFFFF : static_cast<__mmask16>((1U << (n - i)) - 1U);
    const __m512 value = _mm512_mul_ps(_mm512_maskz_loadu_ps(some, in + i), by);
    const __m256h packed = _mm512_cvtxps_ph(_mm512_maskz_max_ps(some, _mm512_maskz_min_ps(some, value, high), low));
    _mm256_mask_storeu_epi16(out + i, some, _mm256_castph_si256(packed));
  }
#else
  for (int i = 0; i < n; ++i) out[i] = std::clamp(scale * in[i], -kMost, kMost);
#endif
}

/// out = scale * in, converted back.
inline void toFloat(const Half* in, float scale, float* out, int n) {
#ifdef __AVX512FP16__
  const __m512 by = _mm512_set1_ps(scale);
  for (int i = 0; i < n; i += 16) {
    const __mmask16 some = n - i >= 16 ? 0xFFFF : static_cast<__mmask16>((1U << (n - i)) - 1U);
    const __m256i packed = _mm256_maskz_loadu_epi16(some, in + i);
    _mm512_mask_storeu_ps(out + i, some, _mm512_mul_ps(_mm512_cvtxph_ps(_mm256_castsi256_ph(packed)), by));
  }
#else
  for (int i = 0; i < n; ++i) out[i] = scale * in[i];
#endif
}

/// out = to + scale * in.
inline void addHalf(const float* to, const Half* in, float scale, float* out, int n) {
#ifdef __AVX512FP16__
  const __m512 by = _mm512_set1_ps(scale);
  for (int i = 0; i < n; i += 16) {
    const __mmask16 some = n - i >= 16 ? 0xFFFF : static_cast<__mmask16>((1U << (n - i)) - 1U);
    const __m256i packed = _mm256_maskz_loadu_epi16(some, in + i);
    const __m512 before = _mm512_maskz_loadu_ps(some, to + i);
    _mm512_mask_storeu_ps(out + i, some, _mm512_fmadd_ps(_mm512_cvtxph_ps(_mm256_castsi256_ph(packed)), by, before));
  }
#else
  for (int i = 0; i < n; ++i) out[i] = to[i] + scale * in[i];
#endif
}

}  // namespace grove::objects::fluid
