#pragma once

#include <cstddef>
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

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return velocity.bytes() + temperature.heldBytes() + particles.bytes();
  }
};

}  // namespace grove::objects::fluid
