#pragma once

#include <memory>

#include "objects/sky/common/panorama.h"
#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::sky {

/// Renders a camera's view of the sky within `rect`, cropped to the rows that the ground may leave visible; null if
/// there are none. Depth is kInfiniteDepth. `sun` is the unit vector towards the sun; pixels around it are sampled more
/// densely. Any thread.
[[nodiscard]] std::shared_ptr<const raster::Image> skyImage(const SkyMaps& maps, world::Vec3 sun,
                                                            const world::Camera& camera, world::Rect rect,
                                                            raster::ImagePool& images);

}  // namespace grove::objects::sky
