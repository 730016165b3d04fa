#pragma once

#include <cstddef>
#include <cstdint>

namespace grove::node {

/// Pixels of a layer, premultiplied RGBA8 and view depth; rows lie `stride` pixels apart in both.
struct LayerPixels {
  const std::uint32_t* colour;
  const float* depth;
  std::ptrdiff_t stride;
};

inline constexpr float kNoEdge = 1.0e30F;

/// A frame while it is put together: what lies behind, and before it an edge, which is all that covers in part, by
/// itself, so that what is laid later still gets between the two. An edge has one depth: what is laid between two parts
/// of one, as a stone between a near and a far leaf, comes behind both. All rows lie `stride` pixels apart.
struct FramePixels {
  std::uint32_t* colour;
  float* depth;
  std::uint32_t* edge;  ///< colour; means nothing where there is none
  float* edgeDepth;     ///< of the nearest that is part of it; kNoEdge where there is none
  std::ptrdiff_t stride;
};

/// Kernel: lays a rectangle of a layer over that of a frame wherever it is not farther than what lies behind. What
/// covers all becomes that, and if it is before the edge, there is none any more. What covers in part becomes a part of
/// the edge, over or under it. The two rectangles do not overlap in memory.
void composite(const LayerPixels& layer, const FramePixels& frame, int width, int height);

/// Kernel: the same for a layer of pixels that cover all, where the frame has no edges; those are neither read nor
/// written.
void compositeOpaque(const LayerPixels& layer, const FramePixels& frame, int width, int height);

/// Kernel: whether all depths of a rectangle, whose rows lie `stride` apart, are less than `depth`.
[[nodiscard]] bool allNearer(const float* depths, std::ptrdiff_t stride, int width, int height, float depth);

/// Kernel: lays the edges of a row over what lies behind; where they cover for half and more, their depth becomes that
/// of the frame.
void layEdges(const FramePixels& frame, int width);

}  // namespace grove::node
