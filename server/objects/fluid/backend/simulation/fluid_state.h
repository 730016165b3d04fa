#pragma once

#include <cstdint>

#include "objects/fluid/backend/simulation/particles.h"
#include "objects/fluid/backend/solver/grid.h"

namespace grove::objects::fluid {

/// The state of a fire, from which another simulation with any number of cells can continue.
struct FluidState {
  Layout layout;
  Velocity velocity;  ///< including ghosts
  Field temperature;  ///< including ghosts
  Particles particles;
  double time = 0.0;  ///< simulated seconds
  std::uint64_t tick = 0;
};

}  // namespace grove::objects::fluid
