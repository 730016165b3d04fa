#pragma once

#include <cstddef>
#include <vector>

#include "raster/image.h"

namespace grove::node {

/// The parts of a frame in which something is drawn over the backdrop: whole strips, each of which is composited as
/// RGBA with depth. Elsewhere the frame is its warped backdrop.
class FreshParts {
 public:
  /// Pixels of a strip's sides; those at the frame's right and bottom may be smaller.
  static constexpr int kStripWidth = 256;
  static constexpr int kStripHeight = 8;

  /// Marks all strips that overlap one of `drawn`.
  FreshParts(const world::Rect& frame, const std::vector<world::Rect>& drawn);

  /// Whether the strip at `left` and `top` is fresh.
  [[nodiscard]] bool isFresh(int left, int top) const;
  /// For each row of the frame, the columns from its first to its last fresh strip.
  [[nodiscard]] std::vector<raster::Span> spans() const;
  /// The fresh strips, from left to right and from the top; neighbours in a row are one rectangle.
  [[nodiscard]] std::vector<world::Rect> strips() const;

 private:
  [[nodiscard]] std::size_t indexOf(int column, int row) const;

  world::Rect frame_;
  int across_;
  std::vector<bool> fresh_;  ///< row by row
};

}  // namespace grove::node
