#pragma once

#include <array>
#include <cstddef>

/// The loops of Shading over particles and over cells of light. Cells are those of a cube with `cells` along each edge,
/// at least two, x fastest.
namespace grove::objects::fluid {

/// Where particles are, in metres from the cube's low corner.
struct ParticlePlaces {
  const float* x;
  const float* y;
  const float* z;
  std::size_t count;
};

struct LightCells {
  int cells;
  float size;  ///< of a cell, metres
};

/// Spreads the particles' optical depths over the eight cells around each, on top of what is in `depth`. Particle after
/// particle, so that sums come out the same on every processor but for rounding. Places near the border use the
/// border's cells.
void depositSmoke(const ParticlePlaces& particles, const float* amounts, const LightCells& grid, float* depth);

/// The optical depth of each particle of a cell: `each` for one that is new and cold. Smoke thins out as it ages, and
/// flames are clear.
void opticalDepths(const float* age, const float* lifetime, const float* temperature, std::size_t count, float each,
                   float* amounts);

/// The sky's light in each cell, from straight above. `above` is room for a row.
void sweepSkyLight(const float* depth, int cells, float* above, float* light);

/// How the sun's light goes through planes of cells across `axis`, the one along which it goes farthest.
struct SunSweep {
  std::array<std::ptrdiff_t, 3> steps;  ///< to the next plane away from the sun; within a plane: to the next cell, row
  std::ptrdiff_t first;                 ///< index of cell (0, 0) of the plane that is nearest to the sun
  std::array<float, 2> shift;           ///< cells, within a plane, towards the sun, of light in the plane before
  float path;                           ///< through a plane, cells
};

/// The sun's light in each cell. On entry `light` is 1 in cells that are open and 0 in solids. `room` holds
/// 2 (cells + 2)^2 floats.
void sweepSunLight(const float* depth, int cells, const SunSweep& sweep, float* room, float* light);

/// The light 0..1 at each particle, from cells.
void lightOfParticles(const ParticlePlaces& particles, const LightCells& grid, const float* light, float* result);

}  // namespace grove::objects::fluid
