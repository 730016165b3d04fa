#pragma once

#include <cstddef>
#include <cstdint>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/solid_grid.h"

/// The loop over all particles.
namespace grove::objects::fluid {

/// Metres of the smoke's column that pass in a second, as the eddies see it.
inline constexpr float kEddyPace = 0.9F;

/// See Particles.
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

/// What particles move in.
struct Surroundings {
  const SolidGrid& solids;
  const Velocity& velocity;
  float cellSize;  ///< metres
};

/// Moves particles on by `seconds`, see Particles::advance(). `newest` is the place along the column, in metres, of a
/// particle that is born now. Returns how many have died and writes which, in order, to `dead`, which has room for all;
/// their places and velocities mean nothing afterwards.
std::size_t moveParticles(const ParticleArrays& particles, std::size_t count, const Surroundings& around, float seconds,
                          float newest, std::uint32_t* dead);

}  // namespace grove::objects::fluid
