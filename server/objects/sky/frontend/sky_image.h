#pragma once

#include <memory>

#include "objects/sky/common/panorama.h"
#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::sky {

/// What a camera sees of the sky within `rect`, cropped to the rows that the ground does not certainly cover; null
/// if none is left. Depth is kInfiniteDepth. Any thread.
[[nodiscard]] std::shared_ptr<const raster::Image> skyImage(const SkyMaps& maps, const world::Camera& camera,
                                                            world::Rect rect, raster::ImagePool& images);

}  // namespace grove::objects::sky
