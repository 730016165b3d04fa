#pragma once

#include <array>
#include <cstdint>

#include "stream/encode/h264/prediction/intra_prediction.h"
#include "stream/encode/h264/residual/residual.h"
#include "stream/encode/motion_vector.h"

namespace grove::stream::h264 {

enum class MacroblockKind : std::uint8_t { kSkipped, kInter, kIntra };

/// What is written of a macroblock.
struct CodedMacroblock {
  MacroblockKind kind = MacroblockKind::kSkipped;
  std::array<MotionVector, 4> vectors{};  ///< of its 8 x 8 blocks; zero if intra
  IntraMode luma = IntraMode::kMean;
  IntraMode chroma = IntraMode::kMean;

  Residual residual;
  std::uint32_t lumaPattern = 0;                ///< bit i: the 8 x 8 block i has coefficients; intra: all or none
  std::uint32_t chromaPattern = 0;              ///< 0: none, 1: DC only, 2: all
  std::array<std::int16_t, 16> lumaDcLevels{};  ///< intra only, in the order of the scan
  std::array<std::array<std::int16_t, 4>, 2> chromaDcLevels{};  ///< of U and V

  [[nodiscard]] bool hasResidual() const { return lumaPattern != 0 || chromaPattern != 0; }

  /// `vector`: that of a skipped macroblock.
  void skip(const MotionVector& vector) {
    kind = MacroblockKind::kSkipped;
    vectors = {vector, vector, vector, vector};
    lumaPattern = 0;
    chromaPattern = 0;
  }
};

}  // namespace grove::stream::h264
