#pragma once

#include <array>
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
template <class Values>
struct Soil {
  struct Channel {
    alignas(64) Values base{};
    alignas(64) Values slope{};
    alignas(64) Values square{};
  };
  std::array<Channel, 3> channels;
  alignas(64) Values grass{};  ///< height, 0 to 1
};

/// As it is sampled.
using SampledSoil = Soil<SoilSamples>;

/// A line from each sample to the next.
struct SoilLine {
  alignas(64) SoilSamples from{};
  alignas(64) SoilSamples step{};  ///< per column

  /// Of column `lane` of the vector of columns that begins at `sample`.
  [[nodiscard]] float at(int sample, int lane) const noexcept {
    static_assert(kLanes == 2 * kCoarse);
    const auto left = static_cast<float>(lane < kCoarse ? lane : kCoarse);
    const auto right = static_cast<float>(lane < kCoarse ? 0 : lane - kCoarse);
    const float* __restrict values = from.data() + sample;
    const float* __restrict steps = step.data() + sample;
    return values[0] + steps[0] * left + steps[1] * right;
  }
};

/// As it is looked up at every column.
using FineSoil = Soil<SoilLine>;

/// Samples the tile that begins at `firstColumn`. `level` is the clearing's mip level.
void sampleSoil(const Frame& frame, const Row& row, int firstColumn, const Clearing& clearing, int level,
                const Daylight& daylight, const ToneTable& tone, std::span<const world::PointLight> lights,
                SampledSoil& out);

/// The row that is `share` of the way from `a` to `b`.
void mixSoil(const SampledSoil& a, const SampledSoil& b, float share, FineSoil& out);

}  // namespace grove::objects::ground
