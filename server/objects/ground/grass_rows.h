#pragma once

#include <array>
#include <cstdint>

#include "objects/ground/frame.h"
#include "objects/ground/meadow_bake.h"
#include "objects/ground/soil_rows.h"

/// Vectorised loops over the grass, which is sampled at every pixel. Grass stands up: each pixel searches the rows
/// nearer to the eye for the first blade that reaches up to it, so blades overlap and hide what is behind them.
namespace grove::objects::ground {

inline constexpr int kRootRows = 128;  ///< rows of grass kept for the search, a power of two

/// The blade that shows at a pixel: in the lower bits how many rows nearer to the eye it stands, above them how much of
/// its root of albedo shows, in steps of 1/kShareSteps.
using Root = std::uint16_t;
inline constexpr unsigned kRootMask = kRootRows - 1;
inline constexpr float kShareSteps = kMeadowStep * 512.0F / kRootStep;

/// Rows of grass: what grows at each pixel, and the screen row that its top reaches; and the blades that show in the
/// current row. Row r is in slot r % kRootRows.
struct GrassRows {
  alignas(64) std::array<std::uint32_t, kRootRows * kTile> texels;
  alignas(64) std::array<std::int16_t, kRootRows * kTile> tops;
  std::array<std::int16_t, kRootRows> highest;  ///< of a row's tops
  alignas(64) std::array<Root, kTile> roots;
};

/// How the meadow's texture is sampled in a row: `taps` samples along the ray, 1, 2 or 4, of one level and, for a share
/// of the pixels, of the next coarser one.
struct MeadowSampling {
  int taps = 1;
  int level = 0;
  float coarser = 0.0F;  ///< 0 to 1
};

/// More taps where the ground is seen at a flatter angle; then the level that leaves neither holes nor mush.
[[nodiscard]] MeadowSampling samplingFor(const Row& row, const Meadow& meadow);

/// Stores what grows in this row.
void growGrass(const Frame& frame, const Row& row, int firstColumn, const Meadow& meadow,
               const MeadowSampling& sampling, const SoilBetween& soil, GrassRows& grass);

/// Finds the blade of each pixel of a row among the `reach` nearer rows.
void findRoots(const Row& row, int reach, const SoilBetween& soil, GrassRows& grass);

}  // namespace grove::objects::ground
