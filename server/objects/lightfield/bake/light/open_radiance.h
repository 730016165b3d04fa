#pragma once

#include <span>
#include <vector>

#include "objects/lightfield/bake/light/lightings.h"
#include "world/geometry.h"

namespace grove::bake {

/// Sky and far meadow in each direction and lighting: means over the solid angle that a direction stands for, so that
/// few directions hold all of the sky's light. Indexed [direction][lighting]. Any thread.
[[nodiscard]] std::vector<world::Vec3> openRadiance(std::span<const world::Vec3> directions,
                                                    const Lightings& lightings);

}  // namespace grove::bake
