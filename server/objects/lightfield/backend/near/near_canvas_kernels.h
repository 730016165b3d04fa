#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/lightfield/backend/near/near_tiles_kernels.h"
#include "objects/lightfield/common/haze.h"
#include "pipeline/vector_bytes.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// Samples from row to row: not a power of two, or rows would compete for the same lines of the cache.
inline constexpr int kNearStride = kNearTileWidth + 16;

/// The samples of a tile, cleared.
struct NearCanvas {
  std::vector<float> nearness = std::vector<float>(std::size_t{kNearStride} * kNearTileHeight, 0.0F);
  /// Alpha is 255, or 0 if empty.
  std::vector<std::uint32_t> colours = std::vector<std::uint32_t>(nearness.size(), 0U);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(nearness, colours); }
};

/// Draws the triangles of a tile whose top left sample is (left, top). The canvas must be clear.
void drawTile(std::span<const ScreenTriangle> triangles, int left, int top, NearCanvas& canvas);

/// Writes a tile into the picture at that pixel, behind haze, and clears the canvas: a pixel is the mean of its
/// samples, and has the depth of the nearest.
void resolveTile(int left, int top, const Haze& haze, NearCanvas& canvas, raster::Image& image);

}  // namespace grove::objects::lightfield
