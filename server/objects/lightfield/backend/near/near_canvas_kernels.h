#pragma once

#include "objects/lightfield/backend/near/half_planes.h"
#include "objects/lightfield/backend/near/near_canvas.h"
#include "objects/lightfield/backend/near/near_tiles.h"

namespace grove::objects::lightfield {

/// Draws the faces of a tile, which must be sorted. The canvas must be clear.
void drawTile(const NearTiles& tiles, int column, int row, const HalfPlanes& halfPlanes, NearCanvas& canvas);

}  // namespace grove::objects::lightfield
