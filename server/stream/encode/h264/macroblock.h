#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stream/encode/motion_vector.h"

namespace grove::stream::h264 {

/// Pixels of a macroblock's side.
inline constexpr int kMacroblock = 16;

/// What later macroblocks, and the deblocking filter, need to know of an encoded one.
struct Macroblock {
  bool intra = false;
  std::uint8_t quantiser = 0;                    ///< of luma, 0 to 51
  std::array<MotionVector, 4> vectors = {};      ///< of its 8 x 8 blocks, row by row; zero if intra
  std::array<std::uint8_t, 16> lumaCounts = {};  ///< non-zero coefficients of its 4 x 4 blocks, row by row
  std::array<std::array<std::uint8_t, 4>, 2> chromaCounts = {};  ///< the same of U and V, without DC
};

/// The macroblocks of a picture, row by row.
struct MacroblockGrid {
  int across = 0;
  int down = 0;
  std::vector<Macroblock> macroblocks = {};

  [[nodiscard]] Macroblock& at(int column, int row) { return macroblocks[index(column, row)]; }
  [[nodiscard]] const Macroblock& at(int column, int row) const { return macroblocks[index(column, row)]; }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(across) + static_cast<std::size_t>(column);
  }
};

}  // namespace grove::stream::h264
