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

/// The same of a frame.
struct FramePixels {
  std::uint32_t* colour;
  float* depth;
  std::ptrdiff_t stride;
};

/// Kernel: lays a rectangle of a layer over that of a frame wherever it is not farther, blended by its coverage. Pixels
/// that it covers for more than half take over its depth. The two do not overlap.
void composite(const LayerPixels& layer, const FramePixels& frame, int width, int height);

}  // namespace grove::node
