#pragma once

#include "objects/fluid/grid.h"

namespace grove::objects::fluid {

/// Gives back the small whirls that the grid wears down (Fedkiw, Stam and Jensen 2001): a force `strength` * cell size
/// * (N x vorticity), N pointing to where there is more of it. One thread; keeps scratch memory.
class VorticityConfinement {
 public:
  explicit VorticityConfinement(const Layout& layout);

  /// Adds the force times `seconds` to the faces between cells. The velocity's ghosts must be filled.
  void apply(float strength, float seconds, float cellSize, Velocity& velocity);

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept { return scratch_.heldBytes(); }

 private:
  const Layout layout_;
  Field scratch_;  ///< planes of centre velocities, vorticity and force around the wave
};

}  // namespace grove::objects::fluid
