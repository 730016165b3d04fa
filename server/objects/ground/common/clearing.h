#pragma once

#include "objects/ground/common/pyramid.h"

namespace grove::objects::ground {

/// What the ground is and what light reaches it, on a square around the origin. Channels of 0..255: how much of the sun
/// is seen, how much of the sky is seen, how dry the grass is, how high the grass stands (0: trodden earth).
/// Beyond the square, the texels at its edge go on.
struct Clearing {
  Pyramid pyramid;
  float metres;  ///< side of the square
};

}  // namespace grove::objects::ground
