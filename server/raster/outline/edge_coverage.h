#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "world/camera.h"

namespace grove::raster {

/// Adjacent pixels of one row that a polygon covers by the same share.
struct CoveredPixels {
  int row = 0;
  int begin = 0;  ///< columns
  int end = 0;
  float share = 0.0F;  ///< above 0 and below 1
};

/// Exact shares of pixels' areas that polygons cover, from their edges alone, as rasterisers of fonts compute them: an
/// edge adds its height to all pixels to its right, and a part of that to its own pixels (FreeType's `ftgrays`).
/// Where polygons overlap, their shares add up.
class EdgeCoverage {
 public:
  /// Removes all edges, for the pixels of a rectangle. Keeps the memory.
  void begin(const world::Rect& rect);

  /// Adds an edge, in pixels. The edges of a polygon run counter-clockwise as seen, on a screen whose y grows
  /// downwards.
  void add(world::Vec2 from, world::Vec2 to);

  /// The pixels that are covered in part, by rows and columns from the rectangle's corner.
  [[nodiscard]] const std::vector<CoveredPixels>& partly();

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Cell {
    std::int32_t row;
    std::int32_t column;  ///< -1: left of the rectangle
    float height;         ///< of the edges within it, positive downwards
    float area;           ///< that they enclose within it, to their right
  };
  void addInRow(int row, float from, float to, float height);
  /// Sorts cells by keys of 0 to before `keys`; those with equal keys keep their order.
  template <class Key>
  void sortBy(const Key& key, int keys, const std::vector<Cell>& from, std::vector<Cell>& to);
  void sweep(int row, std::span<const Cell> cells);
  void report(int row, int begin, int end, float share);

  world::Rect rect_;
  std::vector<Cell> cells_;
  std::vector<Cell> sorted_;
  std::vector<std::uint32_t> starts_;  ///< of each key's cells
  std::vector<CoveredPixels> partly_;
};

}  // namespace grove::raster
