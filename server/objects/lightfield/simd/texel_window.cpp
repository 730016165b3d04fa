#include "objects/lightfield/simd/texel_window.h"

#include <algorithm>
#include <array>

namespace grove::objects::lightfield::simd {
namespace {

constexpr std::size_t kNoTexel = ~std::size_t{0};

/// Calls copyRows(first texel in the field or kNoTexel, first texel in the window, rows) for every block in the box.
template <typename CopyRows>
void forEachBlock(const LightField& field, int level, int view, const TexelBox& box, const WindowLayout& layout,
                  CopyRows copyRows) {
  const int across = field.blocksAcross(level);
  const std::uint32_t* blocks =
      field.blocks[static_cast<std::size_t>(level)].data() + std::ptrdiff_t{view} * across * across;
  for (int line = box.top / kBlock; line <= box.bottom / kBlock; ++line) {
    const int top = std::max(box.top, line * kBlock);
    const int rows = std::min(box.bottom + 1, (line + 1) * kBlock) - top;
    const auto within = static_cast<std::size_t>((top - line * kBlock) * kBlockStride);
    for (int column = box.left / kBlock; column <= box.right / kBlock; ++column) {
      const std::uint32_t block = blocks[line * across + column];
      const std::size_t from = block == kNoBlock ? kNoTexel : std::size_t{block} * kBlockTexels + within;
      copyRows(from, std::ptrdiff_t{top} * layout.stride + column * kBlock - layout.origin, rows);
    }
  }
}

template <typename Texel>
void copyBlock(const Texel* __restrict from, Texel* __restrict to, int stride, int rows) {
  for (int row = 0; row < rows; ++row) {
    std::copy_n(from + std::ptrdiff_t{row} * kBlockStride, kBlock, to + std::ptrdiff_t{row} * stride);
  }
}

template <typename Texel>
void fillBlock(Texel value, Texel* to, int stride, int rows) {
  for (int row = 0; row < rows; ++row) std::fill_n(to + std::ptrdiff_t{row} * stride, kBlock, value);
}

}  // namespace

WindowLayout::WindowLayout(const TexelBox& box)
    : stride((box.right / kBlock - box.left / kBlock + 1) * kBlock),
      origin(box.top * stride + box.left / kBlock * kBlock),
      // One more, for they are read in pairs.
      texels(static_cast<std::size_t>(stride * (box.bottom - box.top + 1) + 1)) {}

void TexelWindow::load(const LightField& field, int level, int view, int lighting, const TexelBox& box) {
  layout_ = WindowLayout(box);
  if (depth_.size() < layout_.texels) {
    depth_.resize(layout_.texels);
    colour_.resize(layout_.texels);
  }
  const std::uint16_t* depths = field.depth.data();
  const std::uint32_t* colours = field.colour[static_cast<std::size_t>(lighting)].data();
  forEachBlock(field, level, view, box, layout_, [&](std::size_t from, std::ptrdiff_t to, int rows) {
    if (from == kNoTexel) {
      fillBlock(kNoDepth, depth_.data() + to, layout_.stride, rows);
      fillBlock(0U, colour_.data() + to, layout_.stride, rows);
    } else {
      copyBlock(depths + from, depth_.data() + to, layout_.stride, rows);
      copyBlock(colours + from, colour_.data() + to, layout_.stride, rows);
    }
  });
}

bool NearnessWindow::load(const LightField& field, int level, const Lens& lens, const TexelBox& box) {
  layout_ = WindowLayout(box);
  if (nearness_.size() < layout_.texels) nearness_.resize(layout_.texels);
  std::array<float, kBlock> high{};
  std::array<float, kBlock> low;
  low.fill(world::kInfiniteDepth);
  forEachBlock(field, level, lens.view, box, layout_, [&](std::size_t from, std::ptrdiff_t to, int rows) {
    float* __restrict out = nearness_.data() + to;
    if (from == kNoTexel) return fillBlock(kNowhere, out, layout_.stride, rows);
    const std::uint16_t* __restrict in = field.depth.data() + from;
    std::array<float, kBlock> blockHigh = high;
    std::array<float, kBlock> blockLow = low;
    for (int row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < kBlock; ++i) {
        const bool covered = in[i] != kNoDepth;
        const float nearness = 1.0F / (lens.nearDepth + static_cast<float>(in[i]) * lens.depthStep);
        out[i] = covered ? nearness : kNowhere;
        blockHigh[i] = std::max(blockHigh[i], covered ? nearness : 0.0F);
        blockLow[i] = std::min(blockLow[i], covered ? nearness : world::kInfiniteDepth);
      }
      in += kBlockStride;
      out += layout_.stride;
    }
    high = blockHigh;
    low = blockLow;
  });
  const float most = *std::max_element(high.begin(), high.end());
  if (most <= 0.0F) return false;
  nearest_ = 1.0F / most;
  farthest_ = 1.0F / *std::min_element(low.begin(), low.end());
  return true;
}

}  // namespace grove::objects::lightfield::simd
