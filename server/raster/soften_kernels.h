#pragma once

#include <cstdint>

#include "world/camera.h"

namespace grove::raster {

/// Weights of a pixel and its two neighbours, down and across.
enum class Softening : std::uint8_t {
  kHalf,    ///< 1 2 1
  kQuarter  ///< 1 6 1
};

/// Kernel: the weighted mean of three rows of colours, channel by channel. `out` may be one of them.
void softenDown(const std::uint32_t* above, const std::uint32_t* here, const std::uint32_t* below, int width,
                Softening softening, std::uint32_t* out);

/// Kernel: the same along one row, whose ends are repeated. `out` is another row.
void softenAcross(const std::uint32_t* row, int width, Softening softening, std::uint32_t* out);

/// Kernel: the min of each depth and its two neighbours.
void nearestAcross(const float* depth, int width, float* out);

/// Kernel: gives covered pixels without a depth the min of three rows. `here` may be `depth`'s own row, widened.
void deepenFringe(const float* above, const float* here, const float* below, const std::uint32_t* colour, int width,
                  float* depth);

}  // namespace grove::raster
