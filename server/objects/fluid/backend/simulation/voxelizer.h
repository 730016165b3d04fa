#pragma once

#include <cstdint>
#include <vector>

#include "world/geometry.h"
#include "world/rays/ray_scene.h"

namespace grove::objects::fluid {

/// A cube of cells in the world.
struct Cube {
  world::Vec3 low{0.0F};  ///< corner, metres
  float size = 8.0F;      ///< edge, metres
  int cells = 64;         ///< per edge

  [[nodiscard]] float cellSize() const noexcept { return size / static_cast<float>(cells); }
};

/// Which cells are solid, one byte each, x fastest. A cell is solid if its centre is inside of the surfaces: rays
/// through the centres along each axis count how often they enter and leave (so that overlapping bodies unite), and two
/// axes of three must agree (so that a surface with a hole, or a mere ground plane, does no harm). Bodies so thin that
/// they lie between two centres are solid where a ray passes through.
[[nodiscard]] std::vector<std::uint8_t> voxelize(const world::RayScene& surfaces, const Cube& cube);

/// 1 where the sun shines, 0 where the surfaces hide it, at the centres of a cube of cells, x fastest.
[[nodiscard]] std::vector<float> sunVisibility(const world::RayScene& surfaces, const Cube& cube,
                                               world::Vec3 towardsSun);

}  // namespace grove::objects::fluid
