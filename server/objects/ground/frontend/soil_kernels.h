#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "objects/ground/common/clearing.h"
#include "objects/ground/frontend/frame.h"
#include "objects/ground/frontend/ground_light.h"
#include "world/light.h"

/// Kernel over light and soil, which change slowly: they are sampled every kCoarse columns and every few rows, with all
/// that the air and the tone curve do to them.
namespace grove::objects::ground {

inline constexpr int kCoarse = 8;  ///< columns between samples
inline constexpr int kCoarseSamples = kTile / kCoarse + 1;
/// Whole vectors of floats on every target.
inline constexpr int kCoarsePadded = (kCoarseSamples + 15) / 16 * 16;

using SoilSamples = std::array<float, kCoarsePadded>;

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

/// Samples the tile that begins at `firstColumn`. `level` is the clearing's mip level.
void sampleSoil(const Frame& frame, const Row& row, int firstColumn, const Clearing& clearing, int level,
                const GroundLight& light, std::span<const world::PointLight> lights, SampledSoil& out);

}  // namespace grove::objects::ground
