#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "stream/encode/h264/deblocking/deblocking_limits.h"
#include "stream/encode/h264/deblocking/deblocking_strengths.h"

namespace grove::stream::h264 {

/// The limits at an edge, for luma and for chroma.
struct EdgeLimits {
  DeblockingLimits luma = {};
  DeblockingLimits chroma = {};
};

/// How to filter a macroblock's edges. Chroma's lie at every second one of luma, and have its strengths.
struct FilteredEdges {
  EdgeStrengths strengths = {};
  EdgeLimits left = {};
  EdgeLimits above = {};
  EdgeLimits inside = {};
};

/// The top left pixels of a macroblock's planes.
struct MacroblockPlace {
  std::uint8_t* luma = nullptr;
  std::array<std::uint8_t*, 2> chroma = {};
  std::ptrdiff_t lumaStride = 0;
  std::ptrdiff_t chromaStride = 0;
};

/// The deblocking filter of ITU-T H.264, 8.7, on one macroblock: vertical edges from left to right, then horizontal
/// ones from top to bottom. May read and write back 8 pixels left of it, in each plane, also where it changes none.
void filterEdges(const FilteredEdges& edges, const MacroblockPlace& pixels);

}  // namespace grove::stream::h264
