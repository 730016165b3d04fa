#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "objects/ground/frontend/soil_kernels.h"

/// Kernels that widen samples of light and soil to all pixels, in 16-bit numbers, of which a vector holds twice as many
/// as of floats.
namespace grove::objects::ground {

/// SampledSoil for every column, two channels after each other as they lie in a texel: red and blue, which are the low
/// bytes of its halves, and green and alpha, the high ones.
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

/// Products of two 16-bit numbers keep their upper halves; blades' `q` come in steps of kRootStep.
inline constexpr float kSoilSteps = 16.0F;
inline constexpr float kMaxGrass = 32760.0F;
inline constexpr float kRootStep = 5.1e-5F;
inline constexpr float kSlopeStep = 1.0F / (kSoilSteps * kRootStep * 65536.0F);
inline constexpr float kSquareStep = kSlopeStep / (kRootStep * 32768.0F);

/// Rows between two that were sampled: that many `steps` from `first`.
struct SoilBetween {
  const FineSoil& first;
  const FineSoil& step;
  int steps;
};

/// Fills the columns between the samples.
void spreadSoil(const SampledSoil& samples, FineSoil& out);

/// What a row adds on the way from `first` to `last`, which is 2 or 4 rows on.
void stepSoil(const FineSoil& first, const FineSoil& last, int rows, FineSoil& out);

}  // namespace grove::objects::ground
