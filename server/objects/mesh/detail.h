#pragma once

#include <cstddef>
#include <cstdint>

#include "objects/mesh/detail_texture.h"
#include "objects/mesh/drawing.h"

namespace grove::objects::mesh {

/// What a renderer finds of one drawing: rows of its rectangle from the top.
struct Fragments {
  /// RGB as of lightVertices(), interpolated; A = sixteenths of relief (high) and lichen (low), 0..15 each.
  const std::uint32_t* surface = nullptr;
  /// Near depth / view depth; 0 where there is nothing.
  const float* depth = nullptr;
  std::ptrdiff_t stride = 0;  ///< pixels from row to row
};

/// Turns fragments into the picture: adds what is too fine for vertices, which is weathering, relief that the sun
/// brings out, and lichen, all fixed to the object's own coordinates. Each scale fades out where it would flicker.
/// Vectorised; any thread. `image` has the drawing's rectangle.
void finish(const Fragments& fragments, const Drawing& drawing, const DetailTexture& texture, node::Image& image);

}  // namespace grove::objects::mesh
