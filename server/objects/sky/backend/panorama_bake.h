#pragma once

#include <functional>

#include "objects/sky/common/panorama.h"
#include "world/sky.h"

namespace grove::objects::sky {

/// Paints sky, sun, clouds and distant landscape; takes seconds at full size. `progress` gets shares of 0..1. Dithers
/// by half a step, so that smooth skies do not band.
[[nodiscard]] Panorama bakePanorama(PanoramaSize size, int seed, const world::Sky& sky,
                                    const std::function<void(float)>& progress);

}  // namespace grove::objects::sky
