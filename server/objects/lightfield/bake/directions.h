#pragma once

#include <vector>

#include "world/geometry.h"

namespace grove::bake {

/// `count` unit vectors spread evenly over the sphere (a Fibonacci spiral), from the top down.
[[nodiscard]] std::vector<world::Vec3> evenDirections(int count);

/// Orthonormal basis around a unit vector, which is its last column (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
[[nodiscard]] glm::mat3 basisAround(world::Vec3 direction) noexcept;

}  // namespace grove::bake
