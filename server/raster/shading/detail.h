#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "raster/drawing.h"
#include "raster/shading/detail_texture.h"

namespace grove::raster {

/// Pixels that are looked at together.
inline constexpr std::size_t kFragmentRoom = 16;

/// What a renderer finds of one drawing: rows of its rectangle from the top. Both arrays can be read for
/// kFragmentRoom pixels beyond the last, whatever is there.
struct Fragments {
  /// RGB as of lightVertices(), interpolated; A = sixteenths of relief (high) and lichen (low), 0..15 each.
  const std::uint32_t* surface = nullptr;
  /// Near depth / view depth; 0 where there is nothing.
  const float* depth = nullptr;
  std::ptrdiff_t stride = 0;  ///< pixels from row to row
  /// By row, the columns that may hold anything; the rest is not looked at. Empty: all of every row.
  std::span<const Span> spans = {};
};

/// Turns fragments into the picture: adds what is too fine for vertices, which is weathering, relief that the sun
/// brings out, and lichen, all fixed to the object's own coordinates. Each scale fades out where it would flicker.
/// Vectorised; any thread. `image` has the drawing's rectangle and takes over the fragments' spans.
void finish(const Fragments& fragments, const Drawing& drawing, const DetailTexture& texture, Image& image);

}  // namespace grove::raster
