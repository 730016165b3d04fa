#pragma once

#include <array>
#include <cstdint>

#include "stream/encode/h264/residual/quantisation.h"

namespace grove::stream::h264 {

/// What is left of a macroblock after prediction.
struct Residual {
  alignas(64) std::array<Block, 16> luma;   ///< quantised, block by block, row by row
  alignas(64) std::array<Block, 8> chroma;  ///< the same: four blocks of U, four of V; without DC
  std::uint32_t lumaBlocks = 0;             ///< bit i: luma[i] is not zero
  std::uint32_t chromaBlocks = 0;
  std::array<std::int16_t, 16> lumaDc{};   ///< DC coefficients before quantisation
  std::array<std::int16_t, 8> chromaDc{};  ///< the same
};

}  // namespace grove::stream::h264
