#pragma once

#include <cstdint>
#include <vector>

#include "world/rays/ray_scene.h"
#include "world/voxel_obstacles.h"

namespace grove::world {

/// Which cells are solid, one byte each, x fastest. A cell is solid if its centre is inside of the surfaces: rays
/// through the centres along each axis count how often they enter and leave (so that overlapping bodies unite), and two
/// axes of three must agree (so that a surface with a hole, or a mere ground plane, does no harm). Bodies so thin that
/// they lie between two centres are solid where a ray passes through.
[[nodiscard]] std::vector<std::uint8_t> voxelize(const RayScene& surfaces, const Cube& cube);

/// 1 where the sun shines, 0 where the surfaces hide it, at the centres of a cube of cells, x fastest.
[[nodiscard]] std::vector<std::uint8_t> sunVisibility(const RayScene& surfaces, const Cube& cube, Vec3 towardsSun);

}  // namespace grove::world
