#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "objects/ground/frontend/soil_kernels.h"

/// Kernels that interpolate samples of light and soil to all pixels, in 16-bit numbers, because a vector holds twice as
/// many of them as of floats.
namespace grove::objects::ground {

/// SampledSoil for every column. Two channels alternate as they lie in a texel: red and blue are the low bytes of its
/// 16-bit halves, green and alpha the high bytes.
struct FineSoil {
  using Line = std::array<std::int16_t, 2 * std::size_t{kTile}>;
  struct Channels {
    alignas(64) Line base;    ///< in steps of 1/kSoilSteps
    alignas(64) Line slope;   ///< in steps of kSlopeStep
    alignas(64) Line square;  ///< in steps of kSquareStep
  };
  Channels low;
  Channels high;
  alignas(64) std::array<std::int16_t, kTile> grass;  ///< in steps of 1/kMaxGrass
};

/// Products of two 16-bit numbers keep their upper 16 bits; the blades' `q` is in steps of kRootStep.
inline constexpr float kSoilSteps = 16.0F;
inline constexpr float kMaxGrass = 32760.0F;
inline constexpr float kRootStep = 5.1e-5F;
inline constexpr float kSlopeStep = 1.0F / (kSoilSteps * kRootStep * 65536.0F);
inline constexpr float kSquareStep = kSlopeStep / (kRootStep * 32768.0F);

/// A row between two sampled rows: `steps` rows from `first`.
struct SoilBetween {
  const FineSoil& first;
  const FineSoil& step;
  int steps;
};

/// Interpolates the columns between the samples.
void spreadSoil(const SampledSoil& samples, FineSoil& out);

/// Computes the difference per row from `first` to `last`, `rows` (2 or 4) rows apart.
void stepSoil(const FineSoil& first, const FineSoil& last, int rows, FineSoil& out);

}  // namespace grove::objects::ground
