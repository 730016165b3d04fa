#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/yuv_image.h"

namespace grove::stream {

/// The blocks of 16 x 16 pixels in which two pictures of one size differ.
class ChangedBlocks {
 public:
  static constexpr int kSide = 16;

  ChangedBlocks(const raster::YuvImage& before, const raster::YuvImage& now);

  /// Rectangles in pixels, without overlap, that contain all changed blocks and few others: cut recursively at the
  /// widest gap between changed blocks (an XY-cut, as in document analysis: Nagy and Seth 1984), as long as a cut saves
  /// at least `minSaved` blocks.
  [[nodiscard]] std::vector<world::Rect> rectangles(int minSaved) const;

 private:
  [[nodiscard]] std::size_t indexOf(int column, int row) const;
  [[nodiscard]] bool isChanged(int column, int row) const;
  [[nodiscard]] world::Rect shrunk(const world::Rect& blocks) const;
  void cut(const world::Rect& blocks, int minSaved, std::vector<world::Rect>& to) const;

  world::Rect picture_;
  int across_ = 0;
  int down_ = 0;
  std::vector<std::uint8_t> changed_;  ///< by block, row by row
};

}  // namespace grove::stream
