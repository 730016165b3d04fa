#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "raster/drawing.h"
#include "raster/shading/detail_texture.h"

namespace grove::raster {

/// Pixels per block.
inline constexpr std::size_t kFragmentRoom = 16;

/// A renderer's output for one drawing: rows of its rectangle from the top. Both arrays are readable for kFragmentRoom
/// pixels beyond the last; their contents there are undefined.
struct Fragments {
  /// RGB interpolated from lightVertices(); A = relief (high) and lichen (low), 0..15 each.
  const std::uint32_t* surface = nullptr;
  /// Near depth / view depth; 0 if empty.
  const float* depth = nullptr;
  std::ptrdiff_t stride = 0;  ///< pixels from row to row
  /// Per row, the columns that may be covered; the rest is not read. Empty: whole rows.
  std::span<const Span> spans = {};
};

/// Turns fragments into the picture: adds detail that is too fine for vertices (weathering, sunlit relief, lichen), all
/// fixed to the object's own coordinates. Each scale fades out where it would flicker. Vectorised; any thread. `image`
/// has the drawing's rectangle and takes over the fragments' spans.
void finish(const Fragments& fragments, const Drawing& drawing, const DetailTexture& texture, Image& image);

}  // namespace grove::raster
