#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/fluid/frontend/smoke_sprites.h"
#include "raster/image.h"
#include "world/camera.h"

/// The loops of SmokeTarget over pixels.
namespace grove::objects::fluid {

/// Sixteen neighbours in a row of the target: a whole number of vector registers a channel, and next to each other in
/// memory.
struct alignas(64) SmokeBlock {
  static constexpr int kWidth = 16;
  float red[kWidth];
  float green[kWidth];
  float blue[kWidth];
  float clear[kWidth];  ///< share of the background that shows through
  float depth[kWidth];  ///< of the scene, metres
};

/// Rows of a column of blocks that were drawn into; empty if end <= begin.
struct SmokeSpan {
  int begin = 0;
  int end = 0;
};

/// Where a SmokeTarget's pixels are. Blocks lie column by column, because sprites are drawn down the columns.
struct SmokePixels {
  [[nodiscard]] SmokeBlock* column(int b) const noexcept { return blocks + std::ptrdiff_t{b} * rect.height(); }

  world::Rect rect;  ///< in pixels of the target, which counts from the frame's corner
  int scale = 2;
  int blocksPerRow = 0;
  SmokeBlock* blocks = nullptr;
  SmokeSpan* spans = nullptr;  ///< of each column
};

/// Empties the pixels and gives them the depth of the frame, see SmokeTarget::begin(). `low` and `high` are room for a
/// row of the target's blocks at the frame's width.
void clearPixels(const raster::Image& frame, float farthest, float* low, float* high, const SmokePixels& pixels);

/// Draws sprites in the given order, each over those before; widens the columns' spans.
void drawSprites(const SmokeSprites& sprites, std::span<const std::uint32_t> order, const SmokePixels& pixels);

}  // namespace grove::objects::fluid
