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

/// The cells of a cube that block smoke and light in a world: the only data about other objects that a simulation of
/// air needs. Computed from models, or requested from a node that has them. One byte per cell, 0 or 1, x fastest. Any
/// thread; throws EnvironmentError if a remote node does not respond.
class VoxelObstacles {
 public:
  virtual ~VoxelObstacles() = default;

  /// 1: the cell blocks smoke.
  [[nodiscard]] virtual std::vector<std::uint8_t> solidCells(const Cube& cube) const = 0;
  /// 1: sunlight from the direction `towardsSun` (a unit vector) reaches the cell's centre.
  [[nodiscard]] virtual std::vector<std::uint8_t> sunlitCells(const Cube& cube, Vec3 towardsSun) const = 0;
};

}  // namespace grove::world
