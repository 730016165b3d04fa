#pragma once

#include <array>
#include <cstdint>

#include "stream/encode/h264/macroblock.h"

namespace grove::stream::h264 {

/// The boundary strengths of an edge of a macroblock, 0 to 4: a byte for each 4 pixels of luma, the lowest for the
/// upper or left ones.
using Strengths = std::uint32_t;

/// The strengths of a macroblock's edges: at its left side or top, and 4, 8 and 12 pixels further.
struct EdgeStrengths {
  std::array<Strengths, 4> vertical = {};
  std::array<Strengths, 4> horizontal = {};
};

/// ITU-T H.264, 8.7.2.1, for frames whose P slices have one reference picture. `left` and `above` are null at the
/// picture's border, whose edges have strength 0. False, and `strengths` not written, if nothing in the macroblock or
/// beside it can give an edge a strength.
bool findStrengths(const Macroblock& macroblock, const Macroblock* left, const Macroblock* above,
                   EdgeStrengths& strengths);

}  // namespace grove::stream::h264
