#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/ground/clearing_bake.h"
#include "objects/ground/daylight.h"
#include "objects/ground/frame.h"

/// Vectorised loops over light and soil, which change slowly: they are sampled every kCoarse columns and every few
/// rows, with all that the air and the tone curve do to them.
namespace grove::objects::ground {

inline constexpr int kCoarse = 8;  ///< columns between samples
inline constexpr int kCoarseSamples = kTile / kCoarse + 1;
inline constexpr int kCoarsePadded = (kCoarseSamples + kLanes - 1) / kLanes * kLanes;

/// One sample is followed by the next even at the end of the padding.
using SoilSamples = std::array<float, kCoarsePadded + kLanes>;

/// Along a row of a tile. What is displayed of a blade whose albedo is `q * q` times the soil's is, as 0..255 and with
/// half a step to round by, `(square * q + slope) * q + base` of each channel: the tone curve as a parabola in the root
/// of albedo, in which it is nearly straight.
struct SampledSoil {
  struct Channel {
    alignas(64) SoilSamples base{};
    alignas(64) SoilSamples slope{};
    alignas(64) SoilSamples square{};
  };
  std::array<Channel, 3> channels;
  alignas(64) SoilSamples grass{};  ///< height, 0 to 1
};

/// The same for every column in 16-bit numbers, two channels after each other as they lie in a texel: red and blue,
/// which are the low bytes of its halves, and green and alpha, the high ones.
struct FineSoil {
  using Line = std::array<std::int16_t, 2 * std::size_t{kTile}>;
  struct Channels {
    alignas(64) Line base;    ///< in steps of 1/kSoilSteps
    alignas(64) Line slope;   ///< in steps of kSlopeStep
    alignas(64) Line square;  ///< in steps of kSquareStep
  };
  Channels low;
  Channels high;
  alignas(64) std::array<std::int16_t, kTile> grass;  ///< in steps of 1/kMostGrass
};

/// Products of two 16-bit numbers keep their upper halves; blades' `q` come in steps of kRootStep.
inline constexpr float kSoilSteps = 16.0F;
inline constexpr float kMostGrass = 32760.0F;
inline constexpr float kRootStep = 5.1e-5F;
inline constexpr float kSlopeStep = 1.0F / (kSoilSteps * kRootStep * 65536.0F);
inline constexpr float kSquareStep = kSlopeStep / (kRootStep * 32768.0F);

/// Rows between two that were sampled: that many `steps` from `first`.
struct SoilBetween {
  const FineSoil& first;
  const FineSoil& step;
  int steps;
};

/// Samples the tile that begins at `firstColumn`. `level` is the clearing's mip level.
void sampleSoil(const Frame& frame, const Row& row, int firstColumn, const Clearing& clearing, int level,
                const Daylight& daylight, const ToneTable& tone, std::span<const world::PointLight> lights,
                SampledSoil& out);

/// Fills the columns between the samples.
void spreadSoil(const SampledSoil& samples, FineSoil& out);

/// What a row adds on the way from `first` to `last`, which is 2 or 4 rows on.
void stepSoil(const FineSoil& first, const FineSoil& last, int rows, FineSoil& out);

}  // namespace grove::objects::ground
