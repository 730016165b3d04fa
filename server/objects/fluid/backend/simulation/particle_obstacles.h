#pragma once

#include "objects/fluid/backend/solver/solid_grid.h"
#include "world/geometry.h"

/// Particles and solids. All places are in cells from the cube's low corner.
namespace grove::objects::fluid {

[[nodiscard]] inline bool inside(const Layout& layout, world::Vec3 at) {
  const float n = static_cast<float>(layout.cells);
  return at.x >= 0.0F && at.y >= 0.0F && at.z >= 0.0F && at.x < n && at.y < n && at.z < n;
}

/// `at` is inside.
[[nodiscard]] inline bool inAir(const SolidGrid& solids, world::Vec3 at) {
  return solids.air()[solids.layout().index(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))] !=
         0;
}

/// Moves `at` to the nearest place in a cell of air at most two cells away; false if there is none.
[[nodiscard]] bool pushOut(const SolidGrid& solids, world::Vec3& at);

/// The longest way that is taken in one piece, along any axis.
inline constexpr float kLongestPiece = 0.9F;

/// Where a particle ends that goes `way` from a place in the air. It goes in pieces shorter than a cell, so that no
/// wall is jumped, and slides along what it meets. May be outside of the cube, where it has left it.
[[nodiscard]] world::Vec3 travel(const SolidGrid& solids, world::Vec3 from, world::Vec3 way);

}  // namespace grove::objects::fluid
