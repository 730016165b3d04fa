#pragma once

#include <memory>

#include "objects/sky/common/panorama.h"
#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::sky {

/// What a camera sees of the sky within `rect`, cropped to the rows that the ground does not certainly cover; null
/// if none is left. Depth is kInfiniteDepth. `sun`: the unit vector towards it, around which more is sampled. Any
/// thread.
[[nodiscard]] std::shared_ptr<const raster::Image> skyImage(const SkyMaps& maps, world::Vec3 sun,
                                                            const world::Camera& camera, world::Rect rect,
                                                            raster::ImagePool& images);

}  // namespace grove::objects::sky
