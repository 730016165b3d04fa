#pragma once

#include <vector>

#include "node/image.h"

namespace grove::node {

/// Puts a frame together from layers. The frame's former contents do not matter: a row is cleared (black, opaque,
/// infinitely far) when the first layer touches it, unless that layer covers it.
class FrameBuilder {
 public:
  /// `frame` starts at (0, 0) and outlives the builder.
  explicit FrameBuilder(Image& frame);

  /// Lays a layer over the frame wherever it is not farther than what is there, blended by its coverage. Pixels that
  /// are covered for more than half take over the layer's depth. The layer's rectangle must lie within the frame.
  void lay(const Image& layer);

  /// The same for a part of a layer that need not be an image: its rows are `stride` pixels apart.
  void lay(const world::Rect& rect, const std::uint32_t* colour, const float* depth, std::ptrdiff_t stride);

  /// Clears the rows that no layer touched.
  void finish();

 private:
  Image& frame_;
  std::vector<bool> touched_;  // by row
};

}  // namespace grove::node
