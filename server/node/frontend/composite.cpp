#include "node/frontend/composite.h"

#include <algorithm>
#include <cassert>

namespace grove::node {
namespace {

constexpr std::uint32_t kOpaqueBlack = 0xFF000000U;
constexpr int kPartWidth = 16;

/// One row; a plain loop without branches that vectorises.
inline void compositeRow(const std::uint32_t* __restrict layerColour, const float* __restrict layerDepth,
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

void clearRow(Image& frame, int row) {
  std::fill_n(frame.colourRow(row), frame.width(), kOpaqueBlack);
  std::fill_n(frame.depthRow(row), frame.width(), world::kInfiniteDepth);
}

}  // namespace

FrameBuilder::FrameBuilder(Image& frame) : frame_(frame), touched_(static_cast<std::size_t>(frame.height()), false) {
  assert(frame.rect.left == 0 && frame.rect.top == 0);
}

void FrameBuilder::lay(const Image& layer) {
  const world::Rect& rect = layer.rect;
  const bool covers = layer.opaque && layer.width() == frame_.width();
  for (int row = 0; row < layer.height(); ++row) {
    const int y = rect.top + row;
    if (touched_[static_cast<std::size_t>(y)] || !covers) {
      const Span span = layer.span(row);
      if (span.begin >= span.end) continue;
      lay({rect.left + span.begin, y, rect.left + span.end, y + 1}, layer.colourRow(row) + span.begin,
          layer.depthRow(row) + span.begin, layer.width());
    } else {
      std::copy_n(layer.colourRow(row), layer.width(), frame_.colourRow(y));
      std::copy_n(layer.depthRow(row), layer.width(), frame_.depthRow(y));
      touched_[static_cast<std::size_t>(y)] = true;
    }
  }
}

void FrameBuilder::lay(const world::Rect& rect, const std::uint32_t* colour, const float* depth,
                       std::ptrdiff_t stride) {
  assert(rect.left >= 0 && rect.top >= 0 && rect.right <= frame_.rect.right && rect.bottom <= frame_.rect.bottom);
  for (int row = 0; row < rect.height(); ++row) {
    const int y = rect.top + row;
    if (!touched_[static_cast<std::size_t>(y)]) clearRow(frame_, y);
    touched_[static_cast<std::size_t>(y)] = true;
    const std::uint32_t* fromColour = colour + row * stride;
    const float* fromDepth = depth + row * stride;
    std::uint32_t* toColour = frame_.colourRow(y) + rect.left;
    float* toDepth = frame_.depthRow(y) + rect.left;
    // The width of most parts, where it helps that the compiler knows it.
    if (rect.width() == kPartWidth) {
      compositeRow(fromColour, fromDepth, toColour, toDepth, kPartWidth);
    } else {
      compositeRow(fromColour, fromDepth, toColour, toDepth, rect.width());
    }
  }
}

void FrameBuilder::finish() {
  for (int row = 0; row < frame_.height(); ++row) {
    if (!touched_[static_cast<std::size_t>(row)]) clearRow(frame_, row);
    touched_[static_cast<std::size_t>(row)] = true;
  }
}

}  // namespace grove::node
