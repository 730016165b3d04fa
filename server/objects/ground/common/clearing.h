#pragma once

#include "objects/ground/common/pyramid.h"

namespace grove::objects::ground {

/// The ground and the light on it, on a square around the origin. Channels of 0..255: visible share of the sun, visible
/// share of the sky, dryness of the grass, height of the grass (0: trodden earth). Beyond the square, the texels at its
/// edge repeat.
struct Clearing {
  Pyramid pyramid;
  float metres;  ///< side of the square
};

}  // namespace grove::objects::ground
