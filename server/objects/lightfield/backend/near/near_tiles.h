#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "world/camera.h"

namespace grove::objects::lightfield {

/// Pixels along each edge of a tile: few enough for the L1 cache, and 8 x 8 blocks of 8 x 8.
inline constexpr int kNearTile = 64;
inline constexpr int kNearBlock = 8;
inline constexpr int kTileBlocks = kNearTile / kNearBlock;

/// Nearness (1 / depth) of 1 per metre as a 16-bit integer. Depths below 0.2 m are clamped.
inline constexpr float kNearnessUnit = 0.2F * 32767.0F;

/// Largest rounding error of an edge's position, pixels.
inline constexpr float kCoverageMargin = 0.125F;

/// The least and the largest of a face's four values.
[[nodiscard]] inline float least(const float (&v)[4]) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); }
[[nodiscard]] inline float most(const float (&v)[4]) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); }

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

/// A face's entry in a tile: its depth order and its bounding box in blocks of 8 x 8 pixels.
struct TileFace {
  std::uint32_t key;  ///< smallest in front
  std::uint32_t face;
  std::uint8_t left;  ///< first and last block
  std::uint8_t right;
  std::uint8_t top;
  std::uint8_t bottom;
  std::int16_t nearest;  ///< in units of kNearnessUnit
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

  /// A tile's faces, after sort() front to back.
  [[nodiscard]] std::span<const TileFace> at(int column, int row) const { return tiles_[tile(column, row)]; }
  [[nodiscard]] const ScreenFace& face(std::uint32_t index) const { return faces_[index]; }

  /// The part of the picture, in pixels, whose tiles have faces: whole tiles, except at the picture's right and bottom.
  [[nodiscard]] world::Rect touched() const;

  [[nodiscard]] int width() const noexcept { return width_; }  ///< pixels
  [[nodiscard]] int height() const noexcept { return height_; }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  [[nodiscard]] std::size_t tile(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(column);
  }
  void sortBy(std::uint32_t shift, const std::vector<TileFace>& from, std::vector<TileFace>& to);

  int width_ = 0;
  int height_ = 0;
  int across_ = 0;  ///< tiles
  int down_ = 0;
  std::vector<ScreenFace> faces_;
  std::vector<std::vector<TileFace>> tiles_;  ///< at least across_ * down_
  std::vector<TileFace> sorted_;
};

}  // namespace grove::objects::lightfield
