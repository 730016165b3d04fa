#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "objects/ground/clearing_bake.h"
#include "objects/ground/meadow_bake.h"
#include "world/light.h"

/// The vectorised loops of the ground, one row of one tile at a time.
///
/// A camera never rolls, so all pixels of a row meet the plane at one depth, and their points lie on a line. Light and
/// soil change slowly and are sampled every kCoarse pixels; grass is sampled at every pixel. Grass stands up: each
/// pixel searches the rows nearer to the eye for the first blade that reaches up to it, so blades overlap and hide what
/// is behind them.
namespace grove::objects::ground {

inline constexpr int kTile = 256;  ///< columns that are worked on together
inline constexpr int kCoarse = 8;  ///< pixels between samples of light and soil
inline constexpr int kCoarseSamples = kTile / kCoarse + 1;
inline constexpr int kCoarsePadded = 48;  ///< the same, rounded up to whole vectors
inline constexpr int kRootRows = 128;     ///< rows of grass kept for the search, a power of two

/// What the rows of a frame have in common. A pixel's ray is `ahead * forwards + side * sidewards` in the plane and
/// `rise` upwards, for one metre of view depth.
struct Frame {
  float eyeX = 0.0F, eyeY = 0.0F, eyeZ = 0.0F;
  float forwardX = 0.0F, forwardZ = 0.0F;         ///< unit, horizontal
  float sideX = 0.0F, sideZ = 0.0F;               ///< unit, horizontal
  float firstSide = 0.0F, sideStep = 0.0F;        ///< of the frame's columns
  float firstInverse = 0.0F, inverseStep = 0.0F;  ///< 1/depth of the frame's rows
  float firstAhead = 0.0F, aheadStep = 0.0F;      ///< of the frame's rows
  float focal = 0.0F;                             ///< pixels
};

/// The world's light as the loops need it, read once from world/light.h.
struct Daylight {
  world::Vec3 sun;  ///< unit vector towards it
  world::Vec3 sunColour;
  world::Vec3 sky;                ///< what level ground reflects of it
  world::Vec3 hazeAside;          ///< haze away from the sun
  world::Vec3 hazeGlow;           ///< what it gains towards the sun
  float logTransmittance = 0.0F;  ///< of one metre of air
  Daylight();
};

/// One row of pixels' centres on the plane.
struct Row {
  int row = 0;
  float depth = 0.0F;
  float ahead = 0.0F;
  float rise = 0.0F;
  float pixelsPerMetre = 0.0F;  ///< of something that stands on this row's ground
};

[[nodiscard]] Row rowAt(const Frame& frame, int row) noexcept;

/// Light and soil along a row; `radiance` is what the soil's mean albedo reflects.
struct CoarseRow {
  alignas(64) std::array<std::array<float, kCoarsePadded>, 3> radiance;
  alignas(64) std::array<std::array<float, kCoarsePadded>, 3> haze;  ///< what the air adds
  alignas(64) std::array<float, kCoarsePadded> transmittance;
  alignas(64) std::array<float, kCoarsePadded> grass;  ///< height of the grass, 0 to 1
};

/// The same at every pixel.
struct FineRow {
  alignas(64) std::array<std::array<float, kTile>, 3> radiance;
  alignas(64) std::array<std::array<float, kTile>, 3> haze;
  alignas(64) std::array<float, kTile> transmittance;
  alignas(64) std::array<float, kTile> grass;
};

/// Rows of the tops of grass, as screen rows, and for each pixel of the current row the row where its blade stands.
struct GrassRows {
  alignas(64) std::array<std::array<std::int16_t, kTile>, kRootRows> tops;
  alignas(64) std::array<std::int16_t, kTile> roots;
};

/// toDisplay() as bytes; index is linear * kToneScale.
struct ToneTable {
  static constexpr int kEntries = 4096;
  static constexpr float kScale = 1024.0F;
  std::array<std::uint32_t, kEntries> bytes;
  ToneTable();
};

/// How the meadow's texture is sampled in a row: `taps` samples along the ray, 1, 2 or 4, of one level and, for a share
/// of the pixels, of the next coarser one.
struct MeadowSampling {
  int taps = 1;
  int level = 0;
  float coarser = 0.0F;  ///< 0 to 1
};

/// Fills `out`, of the columns from `firstColumn` on. `level` is the clearing's mip level.
void sampleClearing(const Frame& frame, const Row& row, int firstColumn, const Clearing& clearing, int level,
                    const Daylight& daylight, std::span<const world::PointLight> lights, CoarseRow& out);

void refine(const CoarseRow& coarse, FineRow& fine);

/// Stores the tops of this row's grass.
void growGrass(const Frame& frame, const Row& row, int firstColumn, const Meadow& meadow,
               const MeadowSampling& sampling, const FineRow& fine, GrassRows& grass);

/// Finds the blade of each pixel of a row among the `reach` nearer rows.
void findRoots(int row, int reach, GrassRows& grass);

/// Colours and depths of a row of the tile.
void shadeRow(const Frame& frame, const Row& row, int firstColumn, const Meadow& meadow, const MeadowSampling& sampling,
              const FineRow& fine, const GrassRows& grass, const ToneTable& tone, std::uint32_t* colour, float* depth);

}  // namespace grove::objects::ground
