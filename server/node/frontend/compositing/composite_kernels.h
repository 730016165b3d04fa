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

/// A frame during compositing: the background, and apart from it an edge, which holds all partly covered surfaces, so
/// that a later layer can still get between the two. An edge has one depth: a layer between two parts of an edge, such
/// as a stone between a near and a far leaf, appears behind both. All rows lie `stride` pixels apart.
struct FramePixels {
  std::uint32_t* colour;
  float* depth;
  std::uint32_t* edge;  ///< colour; undefined where there is no edge
  float* edgeDepth;     ///< of its nearest part; kNoEdge where there is no edge
  std::ptrdiff_t stride;
};

/// Kernel: lays a rectangle of a layer over that of a frame wherever it is not farther than the background. Opaque
/// pixels become the background, and remove the edge if they are before it. Partly covered pixels become a part of the
/// edge, over or under it. The two rectangles do not overlap in memory.
void composite(const LayerPixels& layer, const FramePixels& frame, int width, int height);

/// Kernel: the same for an opaque layer and a frame without edges; does not access edges.
void compositeOpaque(const LayerPixels& layer, const FramePixels& frame, int width, int height);

/// Kernel: whether all depths of a rectangle, whose rows lie `stride` apart, are less than `depth`.
[[nodiscard]] bool allNearer(const float* depths, std::ptrdiff_t stride, int width, int height, float depth);

/// Kernel: lays the edges of a row over the background; where they cover at least half, the frame gets their depth.
void layEdges(const FramePixels& frame, int width);

}  // namespace grove::node
