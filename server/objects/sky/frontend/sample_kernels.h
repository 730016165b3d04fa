#pragma once

#include <cstdint>

#include "objects/sky/common/panorama.h"

namespace grove::objects::sky {

/// View directions of one row of pixels of a camera without roll. All share `up`; in the horizontal plane they go
/// `ahead` forwards and `firstSide + i * sideStep` to the right.
struct RowOfRays {
  float yaw = 0.0F;  ///< of the camera, radians
  float ahead = 1.0F;
  float up = 0.0F;
  float firstSide = 0.0F;
  float sideStep = 0.0F;
};

/// Kernel: fills `count` pixels from the row's `first` on by bilinear look-up. A pixel's value does not depend on which
/// pixels share the call.
void sampleRow(const Panorama& panorama, const RowOfRays& rays, int first, int count, std::uint32_t* colour);

/// Kernel: expands samples of every `step`-th pixel (2 or 4) of two rows to all `count` pixels of the row between them,
/// or of the row itself if both are the same. `above` and `below` hold count / step + 2 samples; `colour` has room for
/// a whole last step.
void widenRow(const std::uint32_t* above, const std::uint32_t* below, int step, int count, std::uint32_t* colour);

}  // namespace grove::objects::sky
