#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "objects/fluid/backend/scalable_simulation.h"
#include "objects/fluid/backend/solver/kinetic_energy.h"
#include "world/rays/ray_obstacles.h"

namespace grove::objects::fluid {

inline constexpr int kGrid = 32;  // of the scene

/// A fire whose grid is swapped while it burns.
class ScalableFire : public testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<FluidSimulation> make(int cells) const {
    FluidSettings settings;
    settings.grid = kGrid;
    settings.size = 6.0F;
    return std::make_unique<FluidSimulation>(settings, world::Vec3(1.0F, 0.0F, 2.0F), nothing_, world::Sky(), cells);
  }
  [[nodiscard]] ScalableSimulation scalable(int cells) const {
    return ScalableSimulation([this](int wanted) { return make(wanted); }, cells);
  }
  static void goOver(ScalableSimulation& simulation, int cells) {
    simulation.setCells(cells);
    while (!simulation.update()) std::this_thread::yield();
    ASSERT_EQ(simulation.current().solver().layout().cells, cells);
  }
  static void run(FluidSimulation& simulation, int ticks) {
    for (int i = 0; i < ticks; ++i) simulation.step(FluidSimulation::kTick, {}, {});
  }

  /// Of the whole fire, in units that do not depend on the cells.
  struct Sums {
    double energy = 0.0;  ///< metres^5 a second^2
    double heat = 0.0;    ///< metres^3
    double height = 0.0;  ///< of the heat, metres
    double smoke = 0.0;   ///< mean height of the particles, metres
  };
  static Sums sumsOf(const FluidSimulation& simulation) {
    Sums sums;
    const FluidSolver& solver = simulation.solver();
    const Layout& layout = solver.layout();
    const double cell = static_cast<double>(solver.cellSize());
    const double volume = cell * cell * cell;
    sums.energy = kineticEnergy(layout, solver.velocity()) * volume;
    for (int z = 0; z < layout.cells; ++z) {
      for (int y = 0; y < layout.cells; ++y) {
        for (int x = 0; x < layout.cells; ++x) {
          const double heat = static_cast<double>(solver.temperature()[layout.index(x, y, z)]) * volume;
          sums.heat += heat;
          sums.height += heat * (y + 0.5) * cell;
        }
      }
    }
    sums.height /= sums.heat;
    for (const float y : simulation.particles().y) sums.smoke += static_cast<double>(y);
    sums.smoke /= static_cast<double>(simulation.particles().count());
    return sums;
  }

  const world::RayScene noSurfaces_{world::Triangles{}};
  const world::RayObstacles nothing_{noSurfaces_, noSurfaces_};
};

}  // namespace grove::objects::fluid
