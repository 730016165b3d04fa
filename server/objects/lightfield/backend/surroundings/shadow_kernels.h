#pragma once

#include "objects/lightfield/backend/surroundings/sun_grid.h"
#include "objects/lightfield/common/picture_part.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

/// Darkens shaded pixels: colour * (shade + (1 - shade) * share of the sun). The shade is the sky's blue light, the
/// share is trilinear. Not for a `whole` grid.
void shadePart(const SunGrid& sun, const ObjectCamera& camera, const PicturePart& part);

}  // namespace grove::objects::lightfield
