#include "node/frontend/composite.h"

#include <algorithm>
#include <cassert>

#include "node/frontend/composite_kernels.h"

namespace grove::node {
namespace {

constexpr std::uint32_t kOpaqueBlack = 0xFF000000U;

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
  for (int y = rect.top; y < rect.bottom; ++y) {
    if (!touched_[static_cast<std::size_t>(y)]) clearRow(frame_, y);
    touched_[static_cast<std::size_t>(y)] = true;
  }
  if (rect.empty()) return;
  const FramePixels frame{frame_.colourRow(rect.top) + rect.left, frame_.depthRow(rect.top) + rect.left,
                          frame_.width()};
  composite({colour, depth, stride}, frame, rect.width(), rect.height());
}

void FrameBuilder::finish() {
  for (int row = 0; row < frame_.height(); ++row) {
    if (!touched_[static_cast<std::size_t>(row)]) clearRow(frame_, row);
    touched_[static_cast<std::size_t>(row)] = true;
  }
}

}  // namespace grove::node
