#pragma once

#include <cstdint>

#include "objects/sky/common/panorama.h"

namespace grove::objects::sky {

/// The directions of one row of pixels of a camera without roll: all rise by the same `up`, and in the plane they are
/// `ahead` forwards and `firstSide + i * sideStep` to the right.
struct RowOfRays {
  float yaw = 0.0F;  ///< of the camera, radians
  float ahead = 1.0F;
  float up = 0.0F;
  float firstSide = 0.0F;
  float sideStep = 0.0F;
};

/// Kernel: fills `count` pixels from the row's `first` on by bilinear look-up. Which pixels are asked for together
/// makes no difference to any of them.
void sampleRow(const Panorama& panorama, const RowOfRays& rays, int first, int count, std::uint32_t* colour);

/// Kernel: widens a row of samples, taken at every `step`-th pixel (2 or 4) of two rows, to all `count` pixels of the
/// row between them (of either row, if both are the same). `above` and `below` hold count / step + 2 samples; `colour`
/// has room for a whole last step.
void widenRow(const std::uint32_t* above, const std::uint32_t* below, int step, int count, std::uint32_t* colour);

}  // namespace grove::objects::sky
