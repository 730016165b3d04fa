#pragma once

#include "objects/herd/common/herd_snapshot.h"
#include "raster/drawing.h"

namespace grove::objects::herd {

/// Makes a fallow deer of size 1 in the rest position of its bones, see bonesOf(). Its vertices name their bones.
[[nodiscard]] raster::LitSurface makeDeer(Kind kind);

}  // namespace grove::objects::herd
