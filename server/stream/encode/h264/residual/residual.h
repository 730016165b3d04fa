#pragma once

#include <array>
#include <cstdint>

#include "stream/encode/h264/residual/quantisation.h"

namespace grove::stream::h264 {

/// Of up to 16 quantised coefficients in the order of the scan: bit i is that of the i-th.
struct LevelBits {
  std::uint16_t nonZero = 0;
  std::uint16_t large = 0;  ///< neither 0 nor 1 nor -1
  std::uint16_t negative = 0;
};

/// What is left of a macroblock after prediction.
struct Residual {
  alignas(64) std::array<Block, 16> luma;   ///< quantised, block by block, row by row
  alignas(64) std::array<Block, 8> chroma;  ///< the same: four blocks of U, four of V; without DC
  std::uint32_t lumaBlocks = 0;             ///< bit i: luma[i] is not zero
  std::uint32_t chromaBlocks = 0;
  std::array<LevelBits, 16> lumaBits;      ///< of blocks that are not zero; undefined of others
  std::array<LevelBits, 8> chromaBits;     ///< the same
  std::array<std::int16_t, 16> lumaDc{};   ///< DC coefficients before quantisation
  std::array<std::int16_t, 8> chromaDc{};  ///< the same
};

}  // namespace grove::stream::h264
