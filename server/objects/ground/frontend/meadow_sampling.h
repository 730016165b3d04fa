#pragma once

#include "objects/ground/common/meadow.h"
#include "objects/ground/frontend/frame.h"

namespace grove::objects::ground {

/// A row's sampling of the meadow's texture: `taps` samples along the ray (1, 2 or 4) of one level and, for a share of
/// the pixels, of the next coarser level.
struct MeadowSampling {
  int taps = 1;
  int level = 0;
  float coarser = 0.0F;  ///< 0 to 1
};

/// Uses more taps at flatter angles, then the level that avoids both holes and blur.
[[nodiscard]] MeadowSampling samplingFor(const Row& row, const Meadow& meadow);

}  // namespace grove::objects::ground
