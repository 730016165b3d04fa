#pragma once

#include <array>
#include <cstdint>

#include "objects/ground/common/meadow.h"
#include "objects/ground/frontend/frame.h"
#include "objects/ground/frontend/spread_kernels.h"

/// Grass is sampled at every pixel. It stands upright: each pixel searches the rows nearer to the eye for the first
/// blade that reaches up to it, so blades overlap and hide each other.
namespace grove::objects::ground {

inline constexpr int kRootRows = 128;  ///< rows of grass kept for the search, a power of two

/// The blade that a pixel shows. Lower bits: how many rows nearer to the eye the blade stands. Upper bits: the visible
/// share of the square root of its albedo, in steps of 1/kShareSteps.
using Root = std::uint16_t;
inline constexpr unsigned kRootMask = kRootRows - 1;
inline constexpr float kShareSteps = kMeadowStep * 512.0F / kRootStep;

/// Rows of grass: each pixel's plants and the screen row of their tops, and the blades that show in the current row.
/// Row r is in slot r % kRootRows.
struct GrassRows {
  alignas(64) std::array<std::uint32_t, kRootRows * kTile> texels;
  alignas(64) std::array<std::int16_t, kRootRows * kTile> tops;
  std::array<std::int16_t, kRootRows> highest;                                          ///< highest of each row's tops
  alignas(64) std::array<float, std::size_t{kRootRows} * kCoarsePadded> inverseDepths;  ///< of the ground, at samples
  alignas(64) std::array<Root, kTile> roots;
};

}  // namespace grove::objects::ground
