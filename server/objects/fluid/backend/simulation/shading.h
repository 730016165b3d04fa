#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "objects/fluid/backend/simulation/particles.h"
#include "objects/fluid/backend/solver/solid_grid.h"
#include "pipeline/vector_bytes.h"
#include "world/geometry.h"

namespace grove::objects::fluid {

/// Computes the share of the sky's and the sun's light that reaches each particle (section 5.2.1: shaded by the
/// particles above). Accumulates smoke in cells twice as wide as the fluid's, then sweeps light through them plane by
/// plane: downwards for the sky, and sheared along the sun's direction for the sun. One thread.
class Shading {
 public:
  /// `cells`: cells per edge of the fluid's grid that belongs to the light; solids may be on a finer grid.
  /// `sunVisible`: the share of the sun that the world's solids leave visible at the coarse cells' centres (x fastest);
  /// empty = all.
  Shading(int cells, float size, world::Vec3 towardsSun, std::vector<float> sunVisible);

  /// Cells per edge of the light's grid for a fluid's grid of `cells`.
  [[nodiscard]] static int coarseCells(int cells) noexcept { return cells / 2; }

  /// Light at each particle, 0..1. `solids` adds the shadows of moving bodies.
  void shade(const Particles& particles, const SolidGrid& solids, std::vector<float>& skyLight,
             std::vector<float>& sunLight);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return pipeline::vectorBytes(sunVisible_, depth_, sky_, sun_, amounts_, room_);
  }

 private:
  void deposit(const Particles& particles);
  /// Sets sun_ to 1 in open cells of light and to 0 in solid ones.
  void openCells(const SolidGrid& solids);
  void sweepSun();
  [[nodiscard]] std::size_t at(int x, int y, int z) const noexcept {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells_) +
           static_cast<std::size_t>(x);
  }

  /// The two fluid cells along an axis that decide whether a cell of light is solid.
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
