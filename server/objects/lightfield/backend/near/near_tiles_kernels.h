#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/lightfield/format/near_model.h"
#include "pipeline/vector_bytes.h"
#include "world/geometry.h"

namespace grove::objects::lightfield {

/// Samples along each edge of a pixel.
inline constexpr int kNearSamples = 2;

/// Samples of a tile of a picture: few enough for the L2 cache.
inline constexpr int kNearTileWidth = 256;
inline constexpr int kNearTileHeight = 128;

/// Dot products of (x, y, z, 1) in object coordinates.
struct NearProjection {
  world::Vec4 x{0.0F};      ///< samples from the picture's left edge, times depth
  world::Vec4 y{0.0F};      ///< samples from its top edge, times depth
  world::Vec4 depth{0.0F};  ///< view depth, metres
};

/// A triangle on the screen, its corners from top to bottom. Lengths are samples of the picture.
struct ScreenTriangle {
  float x[3];
  float y[3];
  float nearness;  ///< 1 / depth at the first corner
  float alongX;    ///< its change per sample
  float alongY;
  float low;  ///< its range
  float high;
  std::uint32_t colour[3];
};

/// The triangles of a picture by the tiles that they touch, row by row.
struct NearTiles {
  int width = 0;  ///< samples of the picture
  int height = 0;
  int across = 0;  ///< tiles
  int down = 0;
  std::vector<std::vector<ScreenTriangle>> triangles;  ///< of at least across * down tiles

  /// Empties the tiles, for a picture of that many samples. Keeps their memory.
  void begin(int pictureWidth, int pictureHeight);

  /// The triangles of a tile.
  [[nodiscard]] std::vector<ScreenTriangle>& at(int column, int row) {
    return triangles[static_cast<std::size_t>(row) * static_cast<std::size_t>(across) +
                     static_cast<std::size_t>(column)];
  }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;
};

/// Adds a cluster's visible triangles to the tiles. `fronts` and `backs`: all colours of one lighting.
void projectCluster(const NearModel& model, const NearCluster& cluster, std::span<const std::uint32_t> fronts,
                    std::span<const std::uint32_t> backs, const NearProjection& projection, NearTiles& tiles);

}  // namespace grove::objects::lightfield
