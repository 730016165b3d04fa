#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "objects/ground/common/clearing.h"
#include "objects/ground/frontend/ground_light.h"
#include "objects/ground/frontend/relief/ground_row.h"
#include "world/light.h"

/// Kernel for light and soil, which vary slowly: they are sampled every kCoarse columns and every few rows, including
/// air and tone curve.
namespace grove::objects::ground {

/// Samples along a row of a tile. The displayed value of a blade whose albedo is `q * q` times the soil's is `(square *
/// q + slope) * q + base` for each channel, as 0..255 plus half a step for rounding. This parabola approximates the
/// tone curve over the square root of albedo, where it is nearly straight.
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
void sampleSoil(const Frame& frame, const GroundRow& ground, int firstColumn, const Clearing& clearing, int level,
                const GroundLight& light, std::span<const world::PointLight> lights, SampledSoil& out);

}  // namespace grove::objects::ground
