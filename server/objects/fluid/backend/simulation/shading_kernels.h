#pragma once

#include <array>
#include <cstddef>

/// Kernels of Shading over particles and cells of light. The cells form a cube with `cells` per edge, at least two, x
/// fastest.
namespace grove::objects::fluid {

/// Particle positions in metres from the cube's low corner.
struct ParticlePlaces {
  const float* x;
  const float* y;
  const float* z;
  std::size_t count;
};

struct LightCells {
  int cells;
  float size;  ///< metres per cell
};

/// Distributes the particles' optical depths over the eight cells around each; adds to `depth`. Works particle by
/// particle, so that all processors sum in the same order and differ only by rounding. Positions near the border use
/// the border's cells.
void depositSmoke(const ParticlePlaces& particles, const float* amounts, const LightCells& grid, float* depth);

/// The optical depth that each particle adds to its cell; `each` is the value for a new, cold particle. Smoke thins out
/// with age, and flames are clear.
void opticalDepths(const float* age, const float* lifetime, const float* temperature, std::size_t count, float each,
                   float* amounts);

/// The sky's light in each cell, from straight above. `above` is a scratch row.
void sweepSkyLight(const float* depth, int cells, float* above, float* light);

/// The sun's path through planes of cells across `axis`, the dominant axis of the sun's direction.
struct SunSweep {
  std::array<std::ptrdiff_t, 3> steps;  ///< to the next plane away from the sun; within a plane: to the next cell, row
  std::ptrdiff_t first;                 ///< index of cell (0, 0) of the plane nearest to the sun
  std::array<float, 2> shift;  ///< shift of the light from plane to plane towards the sun, in cells, within a plane
  float path;                  ///< length of the path through one plane, in cells
};

/// The sun's light in each cell. On entry `light` is 1 in open cells and 0 in solids. `room` is a scratch buffer of 2
/// (cells + 2)^2 floats.
void sweepSunLight(const float* depth, int cells, const SunSweep& sweep, float* room, float* light);

/// Interpolates the light 0..1 at each particle from the cells.
void lightOfParticles(const ParticlePlaces& particles, const LightCells& grid, const float* light, float* result);

}  // namespace grove::objects::fluid
