#pragma once

#include "objects/ground/common/meadow.h"
#include "objects/ground/frontend/frame.h"

namespace grove::objects::ground {

/// How the meadow's texture is sampled in a row: `taps` samples along the ray, 1, 2 or 4, of one level and, for a share
/// of the pixels, of the next coarser one.
struct MeadowSampling {
  int taps = 1;
  int level = 0;
  float coarser = 0.0F;  ///< 0 to 1
};

/// More taps where the ground is seen at a flatter angle; then the level that leaves neither holes nor mush.
[[nodiscard]] MeadowSampling samplingFor(const Row& row, const Meadow& meadow);

}  // namespace grove::objects::ground
