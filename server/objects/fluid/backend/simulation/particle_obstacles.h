#pragma once

#include "objects/fluid/backend/solver/solid_grid.h"
#include "world/geometry.h"

/// Collisions of particles with solids. Positions are in cells from the cube's low corner.
namespace grove::objects::fluid {

[[nodiscard]] inline bool inside(const Layout& layout, world::Vec3 at) {
  const float n = static_cast<float>(layout.cells);
  return at.x >= 0.0F && at.y >= 0.0F && at.z >= 0.0F && at.x < n && at.y < n && at.z < n;
}

/// `at` is inside the cube.
[[nodiscard]] inline bool inAir(const SolidGrid& solids, world::Vec3 at) {
  return solids.air()[solids.layout().index(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))] !=
         0;
}

/// Moves `at` to the nearest position in a cell of air at most two cells away; returns false if there is none.
[[nodiscard]] bool pushOut(const SolidGrid& solids, world::Vec3& at);

/// Longest step of travel(), along any axis.
inline constexpr float kLongestPiece = 0.9F;

/// Returns the end of a particle's way from `from` in the air by `way`. Splits the way into steps shorter than a cell,
/// so that the particle passes through no wall, and slides along solids. The result may lie outside the cube, where the
/// particle has left it.
[[nodiscard]] world::Vec3 travel(const SolidGrid& solids, world::Vec3 from, world::Vec3 way);

}  // namespace grove::objects::fluid
