#pragma once

#include <cstdint>
#include <vector>

#include "world/geometry.h"

namespace grove::world {

/// A cube of cells in the world.
struct Cube {
  Vec3 low{0.0F};     ///< corner, metres
  float size = 8.0F;  ///< edge, metres
  int cells = 64;     ///< per edge

  [[nodiscard]] float cellSize() const noexcept { return size / static_cast<float>(cells); }
};

/// What stops smoke and light in a world, as cells of a cube: all that a simulation of air needs of other objects. It
/// comes from their models, or from a node that has these. One byte for each cell, 0 or 1, x fastest. Any thread;
/// throws EnvironmentError where another node is asked and does not answer.
class VoxelObstacles {
 public:
  virtual ~VoxelObstacles() = default;

  /// 1: the cell stops smoke.
  [[nodiscard]] virtual std::vector<std::uint8_t> solidCells(const Cube& cube) const = 0;
  /// 1: the sun, which stands in that direction (a unit vector), shines on the cell's centre.
  [[nodiscard]] virtual std::vector<std::uint8_t> sunlitCells(const Cube& cube, Vec3 towardsSun) const = 0;
};

}  // namespace grove::world
