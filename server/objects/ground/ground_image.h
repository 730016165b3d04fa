#pragma once

#include <memory>
#include <span>

#include "objects/ground/clearing_bake.h"
#include "objects/ground/daylight.h"
#include "objects/ground/meadow_bake.h"
#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::ground {

/// What is baked once and shared by all visitors.
struct GroundMaps {
  Clearing clearing;
  Meadow meadow;
  ToneTable tone;
  Daylight daylight;
};

/// What a camera sees of the ground within `rect`, cropped to the rows below the horizon; null if there are none or the
/// eye is not above the ground. Depth is that of the plane, or nearer where a blade of grass stands before it. Of the
/// lights the nearest eight count. Any thread.
[[nodiscard]] std::shared_ptr<const raster::Image> groundImage(const GroundMaps& maps, const world::Camera& camera,
                                                               world::Rect rect,
                                                               std::span<const world::PointLight> lights,
                                                               raster::ImagePool& images);

}  // namespace grove::objects::ground
