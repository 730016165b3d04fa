#pragma once

#include <vector>

#include "node/frontend/compositing/composite_kernels.h"
#include "raster/image.h"

namespace grove::node {

/// Puts a frame, or some of its rows, together from layers. The former contents of the frame and of the edges do not
/// matter: a row is cleared (black, opaque, infinitely far) when the first layer touches it, unless that layer covers
/// it. Several builders may work on different rows of a frame at once.
class FrameBuilder {
 public:
  /// `edges` has the frame's left and right, spans the rows that are put together, and is a scratch buffer. Both
  /// outlive the builder.
  FrameBuilder(raster::Image& frame, raster::Image& edges);

  /// The part of a rectangle that lies in the rows that are put together.
  [[nodiscard]] world::Rect clip(const world::Rect& rect) const noexcept;

  /// Keeps the current pixels of these rows instead of clearing them. Call it before any lay(). The caller has written
  /// colour and depth wherever a layer follows.
  void cover();

  /// Composites a layer over these rows where it is not farther than the pixels there, blended by its coverage. A pixel
  /// of partial coverage does not hide layers that come later and lie behind it. Clips the layer to the frame.
  void lay(const raster::Image& layer);

  /// The same for a part of a layer that need not be an image: its rows are `stride` pixels apart. `rect` must lie
  /// within the rows that are put together.
  void lay(const world::Rect& rect, const std::uint32_t* colour, const float* depth, std::ptrdiff_t stride);

  /// Whether `rect` would show nothing of a layer that is at `depth` or beyond.
  [[nodiscard]] bool hides(const world::Rect& rect, float depth) const;

  /// Completes the frame's picture. The depth of a pixel is that of the surface that covers at least half of it.
  void finish();

 private:
  struct Row {
    bool touched = false;
    bool edged = false;
  };
  [[nodiscard]] Row& row(int y) { return rows_[static_cast<std::size_t>(y - edges_.rect.top)]; }
  [[nodiscard]] const Row& row(int y) const { return rows_[static_cast<std::size_t>(y - edges_.rect.top)]; }
  [[nodiscard]] FramePixels pixels(int x, int y) const;
  /// Row of the frame's image.
  [[nodiscard]] int line(int y) const { return y - frame_.rect.top; }
  void clear(int y);
  void layOpaque(const raster::Image& layer, int line, const raster::Span& span);

  raster::Image& frame_;
  raster::Image& edges_;
  std::vector<Row> rows_;
};

}  // namespace grove::node
