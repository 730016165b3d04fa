#pragma once

#include "objects/lightfield/backend/sun_grid.h"
#include "objects/lightfield/common/picture_part.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

/// Darkens what the sun does not reach: colour * (shade + (1 - shade) * share of the sun), the shade being the sky's
/// blue light and the share trilinear. Not for a `whole` grid.
void shadePart(const SunGrid& sun, const ObjectCamera& camera, const PicturePart& part);

}  // namespace grove::objects::lightfield
