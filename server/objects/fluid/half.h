#pragma once

#ifdef __AVX512FP16__
#include <immintrin.h>
#endif

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

/// out = scale * in.
inline void toHalf(const float* in, float scale, Half* out, int n) {
  int i = 0;
#ifdef __AVX512FP16__
  // GCC 12 does not vectorise conversions of this type by itself.
  const __m512 by = _mm512_set1_ps(scale);
  for (; i + 16 <= n; i += 16) {
    _mm256_storeu_ph(out + i, _mm512_cvtxps_ph(_mm512_mul_ps(_mm512_loadu_ps(in + i), by)));
  }
#endif
  for (; i < n; ++i) out[i] = static_cast<Half>(scale * in[i]);
}

/// out = scale * in, converted back.
inline void toFloat(const Half* in, float scale, float* out, int n) {
  int i = 0;
#ifdef __AVX512FP16__
  const __m512 by = _mm512_set1_ps(scale);
  for (; i + 16 <= n; i += 16) {
    _mm512_storeu_ps(out + i, _mm512_mul_ps(_mm512_cvtxph_ps(_mm256_loadu_ph(in + i)), by));
  }
#endif
  for (; i < n; ++i) out[i] = scale * static_cast<float>(in[i]);
}

}  // namespace grove::objects::fluid
