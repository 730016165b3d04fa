#pragma once

#include "objects/lightfield/backend/surroundings/sun_grid.h"
#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// Adds the shadows of other objects to a picture of this object, which its light field cannot contain. Scales the
/// picture's colours, because the surface colours behind them are unknown. `camera` is the image's camera. Vectorised;
/// any thread.
void castShadows(const SunGrid& sun, const ObjectCamera& camera, raster::Image& image);

}  // namespace grove::objects::lightfield
