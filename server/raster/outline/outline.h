#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/outline/edge_coverage.h"
#include "raster/shading/detail.h"
#include "raster/simd/screen_surface.h"

namespace grove::raster {

/// Fragments that may be completed; see Fragments.
struct OpenFragments {
  std::uint32_t* surface = nullptr;
  float* depth = nullptr;
  std::ptrdiff_t stride = 0;
  std::span<Span> spans = {};

  [[nodiscard]] std::ptrdiff_t at(int row, int column) const noexcept { return row * stride + column; }
};

/// Smooths the outline of a drawing, whose rasteriser covers pixels as a whole: each pixel there gets the exact share
/// of its area that lies within the surface's silhouette. Edges within the outline stay as they are. Reused across
/// drawings.
class Outline {
 public:
  /// Finds the pixels that the outline crosses.
  void find(const Drawing& drawing, const ScreenSurface& surface);

  /// Turns the fragments of the drawing that was given to find() into its picture, as raster::finish() does. Pixels
  /// whose centre lies outside get a neighbour's fragment.
  void finish(const OpenFragments& fragments, const Drawing& drawing, const DetailTexture& texture, Image& image);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Pixel {
    int row;
    int column;
    std::uint32_t share;  ///< of 256
  };
  /// A pixel without a fragment, and the neighbour whose fragment it copies.
  struct Copy {
    std::ptrdiff_t to;
    std::ptrdiff_t from;
  };
  void addSilhouettes(const ScreenSurface& surface);
  void complete(const OpenFragments& fragments);
  void scale(Image& image) const;

  world::Rect rect_;
  EdgeCoverage coverage_;
  std::vector<std::uint8_t> isFront_;  ///< 1 or 0, by triangle
  std::vector<Pixel> pixels_;
  std::vector<Copy> copies_;
};

}  // namespace grove::raster
