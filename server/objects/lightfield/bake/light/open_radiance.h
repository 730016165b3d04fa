#pragma once

#include <span>
#include <vector>

#include "objects/lightfield/bake/light/lightings.h"
#include "world/geometry.h"

namespace grove::bake {

/// Radiance of sky and far meadow per direction and lighting: means over each direction's solid angle, so that few
/// directions contain all of the sky's light. Indexed [direction][lighting]. Any thread.
[[nodiscard]] std::vector<world::Vec3> openRadiance(std::span<const world::Vec3> directions,
                                                    const Lightings& lightings);

}  // namespace grove::bake
