#pragma once

#include <vector>

#include "world/geometry.h"

namespace grove::bake {

/// `count` unit vectors distributed evenly over the sphere (a Fibonacci spiral), from the top down.
[[nodiscard]] std::vector<world::Vec3> evenDirections(int count);

}  // namespace grove::bake
