#pragma once

#include <cstddef>
#include <span>

#include "raster/image.h"

namespace grove::node {

/// How near the surfaces of a frame are: 1 / view depth in its camera, 1 / metres, of each cell of 8 x 8 pixels, row by
/// row; 0 if infinitely far. With another frame's camera, the same surfaces can be found there.
/// Several threads may write different cells at once; immutable once it is in a FinishedFrame.
class CellNearness {
 public:
  /// Pixels of a cell's side. Cells at the frame's right and bottom may reach beyond it.
  static constexpr int kCell = 8;

  /// For a frame of this size. Uses memory of the pool; cells have no values until they are written.
  CellNearness(int width, int height, raster::ImagePool& images);
  CellNearness(const CellNearness&) = delete;
  CellNearness& operator=(const CellNearness&) = delete;

  [[nodiscard]] int across() const noexcept { return across_; }
  [[nodiscard]] int down() const noexcept { return down_; }
  [[nodiscard]] std::span<float> row(int row) noexcept { return cells_.subspan(indexOf(row), columns()); }
  [[nodiscard]] std::span<const float> row(int row) const noexcept { return cells_.subspan(indexOf(row), columns()); }
  [[nodiscard]] std::span<float> cells() noexcept { return cells_; }
  [[nodiscard]] std::span<const float> cells() const noexcept { return cells_; }

  /// Writes the cells within a part of the frame, from the depths of its pixels: the nearest of four samples, because
  /// that is mostly what the eye follows where a leaf covers half of a cell. The part begins with a cell, and ends
  /// with one or with the frame, or is empty; `frame` is the whole frame.
  void measure(const raster::Image& frame, const world::Rect& part);

 private:
  [[nodiscard]] std::size_t columns() const noexcept { return static_cast<std::size_t>(across_); }
  [[nodiscard]] std::size_t indexOf(int row) const noexcept { return static_cast<std::size_t>(row) * columns(); }

  int across_;
  int down_;
  raster::ImagePool::Bytes memory_;
  std::span<float> cells_;  ///< in the memory
};

}  // namespace grove::node
