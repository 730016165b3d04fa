#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grove::objects::lightfield {

/// Pixels along each edge of a tile: few enough for the L1 cache, and 8 x 8 blocks of 8 x 8.
inline constexpr int kNearTile = 64;

/// Pixels by which rounding moves a face's edges at most.
inline constexpr float kCoverageMargin = 0.125F;

/// A face on the screen: a quadrilateral, or a triangle whose last two corners are the same.
struct alignas(64) ScreenFace {
  float x[4];               ///< pixels from the picture's left edge
  float y[4];               ///< from its top edge
  float nearness[4];        ///< 1 / depth
  std::uint32_t colour[4];  ///< bytes R, G, B, 255

  /// In pixels; positive if the corners are clockwise as seen, since y grows downwards.
  [[nodiscard]] float twiceArea() const noexcept {
    return (x[2] - x[0]) * (y[3] - y[1]) - (x[3] - x[1]) * (y[2] - y[0]);
  }
};

/// The faces of a picture by the tiles that they touch.
class NearTiles {
 public:
  /// Removes all faces, for a picture of that many pixels. Keeps the memory.
  void begin(int width, int height);

  /// Adds a face whose bounding box is partly in the picture.
  void add(const ScreenFace& face);

  /// Sorts a tile's faces front to back by their middles.
  void sort(int column, int row);

  /// After sort(): the number of a tile's faces, and each of them.
  [[nodiscard]] std::size_t count(int column, int row) const { return tiles_[tile(column, row)].size(); }
  [[nodiscard]] const ScreenFace& at(int column, int row, std::size_t i) const {
    return faces_[tiles_[tile(column, row)][i].face];
  }

  [[nodiscard]] int width() const noexcept { return width_; }  ///< pixels
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] int across() const noexcept { return across_; }  ///< tiles
  [[nodiscard]] int down() const noexcept { return down_; }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Entry {
    std::uint32_t key;  ///< smallest in front
    std::uint32_t face;
  };

  [[nodiscard]] std::size_t tile(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(column);
  }
  void sortBy(std::uint32_t shift, const std::vector<Entry>& from, std::vector<Entry>& to);

  int width_ = 0;
  int height_ = 0;
  int across_ = 0;
  int down_ = 0;
  std::vector<ScreenFace> faces_;
  std::vector<std::vector<Entry>> tiles_;  ///< at least across_ * down_
  std::vector<Entry> sorted_;
};

}  // namespace grove::objects::lightfield
