#include "node/frontend/composite.h"

#include <algorithm>
#include <cassert>

namespace grove::node {
namespace {

constexpr std::uint32_t kOpaqueBlack = 0xFF000000U;

/// One row; a plain loop without branches that vectorises.
void compositeRow(const std::uint32_t* __restrict layerColour, const float* __restrict layerDepth,
                  std::uint32_t* __restrict colour, float* __restrict depth, int width) {
  for (int x = 0; x < width; ++x) {
    const std::uint32_t over = layerColour[x];
    const std::uint32_t under = colour[x];
    const std::uint32_t rest = 255U - (over >> 24U);
    // Two channels at a time; (v + 128 + ((v + 128) >> 8)) >> 8 is v / 255 rounded.
    std::uint32_t even = (under & 0x00FF00FFU) * rest + 0x00800080U;
    std::uint32_t odd = ((under >> 8U) & 0x00FF00FFU) * rest + 0x00800080U;
    even = ((even + ((even >> 8U) & 0x00FF00FFU)) >> 8U) & 0x00FF00FFU;
    odd = (odd + ((odd >> 8U) & 0x00FF00FFU)) & 0xFF00FF00U;
    const std::uint32_t blended = over + (even | odd);
    const bool nearer = layerDepth[x] <= depth[x];
    colour[x] = nearer ? blended : under;
    depth[x] = nearer && rest < 128U ? layerDepth[x] : depth[x];
  }
}

}  // namespace

void clear(Image& frame) {
  std::ranges::fill(frame.colour, kOpaqueBlack);
  std::ranges::fill(frame.depth, world::kInfiniteDepth);
}

void compositeByDepth(const Image& layer, Image& frame) {
  const world::Rect& rect = layer.rect;
  assert(frame.rect.left == 0 && frame.rect.top == 0);
  assert(rect.left >= 0 && rect.top >= 0 && rect.right <= frame.rect.right && rect.bottom <= frame.rect.bottom);
  for (int row = 0; row < layer.height(); ++row) {
    compositeRow(layer.colourRow(row), layer.depthRow(row), frame.colourRow(rect.top + row) + rect.left,
                 frame.depthRow(rect.top + row) + rect.left, layer.width());
  }
}

}  // namespace grove::node
