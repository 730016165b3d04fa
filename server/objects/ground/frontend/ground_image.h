#pragma once

#include <memory>
#include <span>

#include "objects/ground/common/ground_maps.h"
#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::ground {

/// What a camera sees of the ground within `rect`, cropped to the rows below the horizon; null if there are none or the
/// eye is not above the ground. Depth is that of the plane, or nearer where a blade of grass stands before it. Of the
/// lights the nearest eight count. Any thread.
[[nodiscard]] std::shared_ptr<const raster::Image> groundImage(const GroundMaps& maps, const world::Camera& camera,
                                                               world::Rect rect,
                                                               std::span<const world::PointLight> lights,
                                                               raster::ImagePool& images);

}  // namespace grove::objects::ground
