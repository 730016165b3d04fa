#pragma once

#include "objects/lightfield/backend/near/near_canvas.h"
#include "objects/lightfield/common/haze.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// Writes a tile into the picture at that pixel, behind haze, and clears the canvas: a pixel is the mean of its
/// samples, and has the depth of the nearest.
void resolveTile(int left, int top, const Haze& haze, NearCanvas& canvas, raster::Image& image);

}  // namespace grove::objects::lightfield
