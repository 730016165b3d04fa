#pragma once

#include <memory>
#include <vector>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/team.h"

namespace grove::objects::fluid {

/// Restores the small whirls that numerical diffusion removes (Fedkiw, Stam and Jensen 2001): a force `strength` * cell
/// size * (N x vorticity), where N points to stronger vorticity. Each thread of a team works on one slab. Used by one
/// thread; keeps scratch memory.
class VorticityConfinement {
 public:
  explicit VorticityConfinement(const Layout& layout, std::shared_ptr<Team> team);

  /// Adds the force times `seconds` to the faces between cells. The velocity's ghosts must be filled.
  void apply(float strength, float seconds, float cellSize, Velocity& velocity);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = 0;
    for (const Field& slab : scratch_) sum += slab.heldBytes();
    return sum;
  }

 private:
  void average(int axis, int z, const Velocity& velocity, float* centres) const;
  [[nodiscard]] float* beside(Field& scratch, const Slab& slab, int axis, int z) const;
  void keepBeside(const Slab& slab, Field& scratch, const Velocity& velocity) const;
  struct Pass;

  const Layout layout_;
  const std::shared_ptr<Team> team_;
  std::vector<Field> scratch_;  ///< planes around the sweep, one field per thread of the team
};

}  // namespace grove::objects::fluid
