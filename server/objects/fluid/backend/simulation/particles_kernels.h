#pragma once

#include <cstddef>
#include <cstdint>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/solid_grid.h"

/// Kernel over all particles.
namespace grove::objects::fluid {

/// Speed of the smoke's column in the coordinates of the eddies, metres per second.
inline constexpr float kEddyPace = 0.9F;

/// Members are those of Particles.
struct ParticleArrays {
  float* x;
  float* y;
  float* z;
  float* velocityX;
  float* velocityY;
  float* velocityZ;
  float* age;
  float* lifetime;
  float* temperature;
  float* cooling;
};

/// The velocity and solids around the particles.
struct Surroundings {
  const SolidGrid& solids;
  const Velocity& velocity;
  float cellSize;  ///< metres
};

/// Moves particles by `seconds`, see Particles::advance(). `newest` is the position along the column, in metres, of a
/// particle that is born now. Returns the number of deaths and writes their indices in ascending order to `dead`, which
/// has room for all particles; positions and velocities of dead particles are undefined.
std::size_t moveParticles(const ParticleArrays& particles, std::size_t count, const Surroundings& around, float seconds,
                          float newest, std::uint32_t* dead);

}  // namespace grove::objects::fluid
