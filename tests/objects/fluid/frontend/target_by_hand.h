#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "objects/fluid/frontend/smoke_target_kernels.h"
#include "objects/fluid/frontend/smoke_upsample_kernels.h"

namespace grove::objects::fluid::testing {

inline constexpr int kWidth = SmokeBlock::kWidth;

/// A target's memory for a part of a frame.
struct Target {
  Target(const world::Rect& rect, int scale) {
    pixels.rect = rect;
    pixels.scale = scale;
    pixels.blocksPerRow = (rect.width() + kWidth - 1) / kWidth;
    const auto columns = static_cast<std::size_t>(pixels.blocksPerRow);
    blocks.resize(columns * static_cast<std::size_t>(rect.height()));
    spans.assign(columns, {rect.height(), 0});
    const std::size_t wide = (columns + 2) * kWidth * static_cast<std::size_t>(scale);
    for (std::vector<float>* room : {&low, &high, &line}) room->resize(wide);
    wideRows.resize(kWideRows * 4 * wide);
    jumps.resize(wide);
    kept.resize(wide);
    pixels.blocks = blocks.data();
    pixels.spans = spans.data();
  }

  [[nodiscard]] SmokeBlock& block(int x, int y) const { return pixels.column(x / kWidth)[y]; }

  SmokePixels pixels;
  std::vector<SmokeBlock> blocks;
  std::vector<SmokeSpan> spans;
  std::vector<float> low, high, line, wideRows;
  std::vector<std::int32_t> jumps;
  std::vector<std::uint32_t> kept;
};

}  // namespace grove::objects::fluid::testing
