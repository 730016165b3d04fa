#pragma once

#include <vector>

#include "world/geometry.h"

namespace grove::bake {

/// `count` unit vectors distributed evenly over the sphere (a Fibonacci spiral), from the top down.
[[nodiscard]] std::vector<world::Vec3> evenDirections(int count);

/// Orthonormal basis with the unit vector as its last column (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
[[nodiscard]] glm::mat3 basisAround(world::Vec3 direction) noexcept;

}  // namespace grove::bake
