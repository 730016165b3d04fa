#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "objects/fluid/backend/simulation/particles.h"
#include "objects/fluid/backend/solver/solid_grid.h"
#include "pipeline/vector_bytes.h"
#include "world/geometry.h"

namespace grove::objects::fluid {

/// How much of the sky's and of the sun's light reaches each particle (section 5.2.1: shaded by the particles above).
/// Smoke is counted into cells twice as wide as the fluid's; light then sweeps through them a plane at a time,
/// downwards for the sky, and sheared along the sun's direction for the sun. One thread.
class Shading {
 public:
  /// `cells`: of the fluid's grid that the light goes with; what solids it meets may be on a finer one. `sunVisible`:
  /// what the world's solids leave of the sun at the coarse cells' centres (x fastest), empty = all.
  Shading(int cells, float size, world::Vec3 towardsSun, std::vector<float> sunVisible);

  /// Cells along the edge of a grid of `cells` that light is computed in.
  [[nodiscard]] static int coarseCells(int cells) noexcept { return cells / 2; }

  /// Light at each particle, 0..1. `solids` adds the shadows of whatever moves.
  void shade(const Particles& particles, const SolidGrid& solids, std::vector<float>& skyLight,
             std::vector<float>& sunLight);

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return pipeline::vectorBytes(sunVisible_, depth_, sky_, sun_, amounts_, room_);
  }

 private:
  void deposit(const Particles& particles);
  /// Sets sun_ to 1 in cells of light that are open and to 0 in solid ones.
  void openCells(const SolidGrid& solids);
  void sweepSun();
  [[nodiscard]] std::size_t at(int x, int y, int z) const noexcept {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells_) +
           static_cast<std::size_t>(x);
  }

  /// Cells of a fluid's grid, along any axis, whose being solid counts for a cell of light.
  struct Inside {
    int low = 0;
    int high = 0;
  };
  [[nodiscard]] std::vector<Inside> insides(int fluidCells) const;

  const int cells_;
  const float cellSize_;
  const world::Vec3 towardsSun_;
  const std::vector<float> sunVisible_;
  std::vector<float> depth_;  ///< optical depth of each cell
  std::vector<float> sky_;
  std::vector<float> sun_;
  std::vector<float> amounts_;  ///< optical depth of each particle
  std::vector<float> room_;
};

}  // namespace grove::objects::fluid
