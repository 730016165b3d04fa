#pragma once

#include <cstdint>

#include "objects/fluid/frontend/smoke_target_kernels.h"

/// Upsamples smoke from its target into the frame.
namespace grove::objects::fluid {

/// Number of cached widened rows.
inline constexpr int kWideRows = 3;

/// Scratch rows. Widths are those of the target's blocks; padded: one more block on either side.
struct UpsampleRoom {
  float* low;           ///< nearest depths, padded
  float* high;          ///< farthest depths, padded
  float* line;          ///< one channel of a row, padded
  float* wide;          ///< kWideRows rows of four channels at the frame's width
  std::int32_t* jumps;  ///< pixels at depth jumps, padded
  std::uint32_t* kept;  ///< the frame's pixels there, at the frame's width
};

/// See SmokeTarget::blendInto(); `farthest` as in SmokeTarget::begin().
void blendPixels(const SmokePixels& pixels, const UpsampleRoom& room, float nearest, float farthest,
                 raster::Image& frame);

}  // namespace grove::objects::fluid
