#pragma once

#include "objects/lightfield/backend/surroundings/rims.h"
#include "objects/lightfield/common/picture_part.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::objects::lightfield {

/// Makes pixels near the tile's rims transparent; their depth stays.
void thinPart(const Rims& rims, const ObjectCamera& camera, const PicturePart& part);

}  // namespace grove::objects::lightfield
