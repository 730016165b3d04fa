#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/fluid/frontend/smoke_sprites.h"
#include "raster/image.h"
#include "world/camera.h"

/// Kernels of SmokeTarget over pixels.
namespace grove::objects::fluid {

/// Sixteen adjacent pixels of a target row: a whole number of vector registers per channel, contiguous in memory.
struct alignas(64) SmokeBlock {
  static constexpr int kWidth = 16;
  float red[kWidth];
  float green[kWidth];
  float blue[kWidth];
  float clear[kWidth];  ///< share of the background that remains visible
  float depth[kWidth];  ///< of the scene, metres
  // Means over the smoke, times its coverage.
  float age[kWidth];       ///< seconds since the smoke's birth
  float distance[kWidth];  ///< view depth, metres
};

/// Touched rows of a column of blocks; empty if end <= begin.
struct SmokeSpan {
  int begin = 0;
  int end = 0;
};

/// Pixels of a SmokeTarget. Blocks are stored column by column, because sprites are drawn down the columns.
struct SmokePixels {
  [[nodiscard]] SmokeBlock* column(int b) const noexcept { return blocks + std::ptrdiff_t{b} * rect.height(); }

  world::Rect rect;  ///< in target pixels from the frame's corner
  int scale = 2;
  int blocksPerRow = 0;
  SmokeBlock* blocks = nullptr;
  SmokeSpan* spans = nullptr;  ///< one per column
};

/// Clears the pixels and sets their depth from the frame, see SmokeTarget::begin(). `low` and `high` are scratch rows
/// of the target's blocks at the frame's width.
void clearPixels(const raster::Image& frame, float farthest, float* low, float* high, const SmokePixels& pixels);

/// Draws sprites in the given order, each over the previous ones; extends the columns' spans.
void drawSprites(const SmokeSprites& sprites, std::span<const std::uint32_t> order, const SmokePixels& pixels);

}  // namespace grove::objects::fluid
