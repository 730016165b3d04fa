#pragma once

#include <cstdint>
#include <vector>

#include "world/rays/ray_scene.h"
#include "world/voxel_obstacles.h"

namespace grove::world {

/// Returns the solid cells, one byte each, x fastest. A cell is solid if its centre is inside the surfaces: rays
/// through the centres along each axis count entries and exits (so that overlapping bodies unite), and two of three
/// axes must agree (so that a surface with a hole, or a mere ground plane, does no harm). Bodies too thin to contain a
/// centre are solid where a ray passes through them.
[[nodiscard]] std::vector<std::uint8_t> voxelize(const RayScene& surfaces, const Cube& cube);

/// 1 in sunlight, 0 where the surfaces block the sun, at the centres of a cube of cells, x fastest.
[[nodiscard]] std::vector<std::uint8_t> sunVisibility(const RayScene& surfaces, const Cube& cube, Vec3 towardsSun);

}  // namespace grove::world
