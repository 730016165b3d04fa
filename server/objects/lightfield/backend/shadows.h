#pragma once

#include "objects/lightfield/backend/sun_grid.h"
#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// Gives a picture what its light field cannot know: the shadows that others cast on this object. It has the picture's
/// colours alone, not the surface behind them, so it scales what is there. Vectorised; any thread. `camera` is the one
/// that the image was made with.
void castShadows(const SunGrid& sun, const ObjectCamera& camera, raster::Image& image);

}  // namespace grove::objects::lightfield
