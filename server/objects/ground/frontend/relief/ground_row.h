#pragma once

#include <array>
#include <span>
#include <vector>

#include "objects/ground/frontend/frame.h"
#include "world/ground/hills.h"

namespace grove::objects::ground {

inline constexpr int kCoarse = 8;  ///< columns between samples
inline constexpr int kCoarseSamples = kTile / kCoarse + 1;
/// A whole number of vectors of floats on every target.
inline constexpr int kCoarsePadded = (kCoarseSamples + 15) / 16 * 16;

using SoilSamples = std::array<float, kCoarsePadded>;

/// Where the rays of a row's samples meet the ground, along one strip. Metres.
struct GroundRow {
  int row = 0;
  float ahead = 0.0F;           ///< see Frame
  float rise = 0.0F;            ///< see Frame
  alignas(64) SoilSamples x{};  ///< of the world
  alignas(64) SoilSamples z{};  ///< of the world
  alignas(64) SoilSamples depth{};
  alignas(64) SoilSamples step{};  ///< depth between this row and the next nearer one
  /// The place and depth whose light the row shows: those of a crest in the rows that its grass reaches.
  alignas(64) SoilSamples litX{};
  alignas(64) SoilSamples litZ{};
  alignas(64) SoilSamples litDepth{};
  alignas(64) SoilSamples crestRows{};  ///< number of rows that the grass of the last crest still reaches
};

/// The means of a row's samples.
[[nodiscard]] Row meanOf(const Frame& frame, const GroundRow& ground) noexcept;

/// The hills that the rays of a strip's rows from `top` to `bottom` may meet.
[[nodiscard]] std::vector<world::Hill> hillsBefore(const Frame& frame, int firstColumn, int top, int bottom,
                                                   std::span<const world::Hill> hills);

}  // namespace grove::objects::ground
