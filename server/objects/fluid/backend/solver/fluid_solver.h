#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "objects/fluid/backend/solver/advection/advection.h"
#include "objects/fluid/backend/solver/forces/forces.h"
#include "objects/fluid/backend/solver/forces/vorticity_confinement.h"
#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/pressure_solver.h"
#include "objects/fluid/backend/solver/solid_grid.h"
#include "objects/fluid/backend/solver/team.h"

namespace grove::objects::fluid {

/// Stable fluids (Stam 1999) on a staggered grid: velocity and temperature of the air in a cube, around solids.
/// Independent of particles and world. Used by one thread.
class FluidSolver {
 public:
  struct Settings {
    int cells = 64;     ///< per edge; a multiple of 8 from 16 to 128
    float size = 8.0F;  ///< edge in metres
    Sides sides;
    Air air;
    float confinement = 0.12F;  ///< strength of vorticity confinement
    PressureSolver::Options pressure;
    int threads = 1;  ///< threads that share the work; the results do not depend on them
  };

  explicit FluidSolver(const Settings& settings);

  /// Sets the static solids, see SolidGrid::setStatic(), and prepares the pressure solver for them.
  void setStatic(std::span<const std::uint8_t> solid);

  /// Continues with the velocity and temperature of another grid of the same cube, as they are after a tick. The next
  /// project() removes the divergence of the resampled velocity.
  void takeOver(const Layout& layout, const Velocity& velocity, const Field& temperature);

  // A tick calls these functions in this order.

  /// Advects velocity and temperature.
  void advect(float seconds);
  /// Applies buoyancy, wind, cooling, the heat source and gusts (in the fluid's own coordinates).
  void force(float seconds, const HeatSource* source, std::span<const world::Gust> gusts, double time);
  void confine(float seconds);
  /// Applies the solids and removes divergence.
  PressureSolver::SolveResult project();

  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
  [[nodiscard]] const Layout& layout() const noexcept { return layout_; }
  [[nodiscard]] float cellSize() const noexcept { return settings_.size / static_cast<float>(settings_.cells); }
  [[nodiscard]] Velocity& velocity() noexcept { return velocity_; }
  [[nodiscard]] const Velocity& velocity() const noexcept { return velocity_; }
  [[nodiscard]] Field& temperature() noexcept { return temperature_; }
  [[nodiscard]] const Field& temperature() const noexcept { return temperature_; }
  [[nodiscard]] SolidGrid& solids() noexcept { return solids_; }
  [[nodiscard]] const SolidGrid& solids() const noexcept { return solids_; }
  [[nodiscard]] const PressureSolver& pressure() const noexcept { return pressure_; }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return solids_.bytes() + velocity_.bytes() + nextVelocity_.bytes() + heldBytes(temperature_, nextTemperature_) +
           advection_.bytes() + confinement_.bytes() + pressure_.bytes();
  }

 private:
  const Settings settings_;
  const Layout layout_;
  SolidGrid solids_;
  Velocity velocity_;
  Velocity nextVelocity_;
  Field temperature_;
  Field nextTemperature_;
  const std::shared_ptr<Team> team_;
  Advection advection_;
  VorticityConfinement confinement_;
  PressureSolver pressure_;
};

}  // namespace grove::objects::fluid
