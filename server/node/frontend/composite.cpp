#include "node/frontend/composite.h"

#include <algorithm>
#include <cassert>

namespace grove::node {
namespace {

constexpr std::uint32_t kOpaqueBlack = 0xFF000000U;

}  // namespace

FrameBuilder::FrameBuilder(Image& frame, Image& edges)
    : frame_(frame), edges_(edges), rows_(static_cast<std::size_t>(frame.height())) {
  assert(frame.rect.left == 0 && frame.rect.top == 0 && edges.rect == frame.rect);
}

void FrameBuilder::lay(const Image& layer) {
  for (int row = 0; row < layer.height(); ++row) {
    const Span span = layer.span(row);
    const int y = layer.rect.top + row;
    if (layer.opaque && !rows_[static_cast<std::size_t>(y)].edged) {
      layOpaque(layer, row);
    } else if (span.begin < span.end) {
      lay({layer.rect.left + span.begin, y, layer.rect.left + span.end, y + 1}, layer.colourRow(row) + span.begin,
          layer.depthRow(row) + span.begin, layer.width());
    }
  }
}

void FrameBuilder::layOpaque(const Image& layer, int row) {
  const int y = layer.rect.top + row;
  const Span span = layer.span(row);
  const int width = span.end - span.begin;
  if (width <= 0) return;
  const std::uint32_t* const colour = layer.colourRow(row) + span.begin;
  const float* const depth = layer.depthRow(row) + span.begin;
  if (!rows_[static_cast<std::size_t>(y)].touched && width == frame_.width()) {
    std::copy_n(colour, width, frame_.colourRow(y));
    std::copy_n(depth, width, frame_.depthRow(y));
    rows_[static_cast<std::size_t>(y)].touched = true;
  } else {
    clear(y);
    compositeOpaque({colour, depth, layer.width()}, pixels(layer.rect.left + span.begin, y), width, 1);
  }
}

void FrameBuilder::lay(const world::Rect& rect, const std::uint32_t* colour, const float* depth,
                       std::ptrdiff_t stride) {
  assert(rect.left >= 0 && rect.top >= 0 && rect.right <= frame_.rect.right && rect.bottom <= frame_.rect.bottom);
  if (rect.empty()) return;
  for (int y = rect.top; y < rect.bottom; ++y) {
    clear(y);
    bool& edged = rows_[static_cast<std::size_t>(y)].edged;
    if (!edged) std::fill_n(edges_.depthRow(y), edges_.width(), kNoEdge);
    edged = true;
  }
  composite({colour, depth, stride}, pixels(rect.left, rect.top), rect.width(), rect.height());
}

bool FrameBuilder::hides(const world::Rect& rect, float depth) const {
  if (rect.empty()) return true;
  for (int y = rect.top; y < rect.bottom; ++y) {
    if (!rows_[static_cast<std::size_t>(y)].touched) return false;
  }
  return allNearer(frame_.depthRow(rect.top) + rect.left, frame_.width(), rect.width(), rect.height(), depth);
}

void FrameBuilder::finish() {
  for (int y = 0; y < frame_.height(); ++y) {
    clear(y);
    bool& edged = rows_[static_cast<std::size_t>(y)].edged;
    if (edged) layEdges(pixels(0, y), frame_.width());
    edged = false;
  }
}

FramePixels FrameBuilder::pixels(int x, int y) const {
  return {frame_.colourRow(y) + x, frame_.depthRow(y) + x, edges_.colourRow(y) + x, edges_.depthRow(y) + x,
          frame_.width()};
}

void FrameBuilder::clear(int y) {
  bool& touched = rows_[static_cast<std::size_t>(y)].touched;
  if (touched) return;
  std::fill_n(frame_.colourRow(y), frame_.width(), kOpaqueBlack);
  std::fill_n(frame_.depthRow(y), frame_.width(), world::kInfiniteDepth);
  touched = true;
}

}  // namespace grove::node
