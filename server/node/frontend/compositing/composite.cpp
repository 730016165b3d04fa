#include "node/frontend/compositing/composite.h"

#include <algorithm>
#include <cassert>

namespace grove::node {
namespace {

constexpr std::uint32_t kOpaqueBlack = 0xFF000000U;

}  // namespace

FrameBuilder::FrameBuilder(raster::Image& frame, raster::Image& edges)
    : frame_(frame), edges_(edges), rows_(static_cast<std::size_t>(edges.height())) {
  assert(edges.rect.left == frame.rect.left && edges.rect.right == frame.rect.right);
  assert(edges.rect.top >= frame.rect.top && edges.rect.bottom <= frame.rect.bottom);
}

world::Rect FrameBuilder::clip(const world::Rect& rect) const noexcept {
  return {rect.left, std::max(rect.top, edges_.rect.top), rect.right, std::min(rect.bottom, edges_.rect.bottom)};
}

void FrameBuilder::cover() {
  for (Row& each : rows_) each.touched = true;
}

void FrameBuilder::lay(const raster::Image& layer) {
  const world::Rect part = clip(layer.rect);
  for (int y = part.top; y < part.bottom; ++y) {
    const int line = y - layer.rect.top;
    const raster::Span whole = layer.span(line);
    const raster::Span span{std::max(whole.begin, frame_.rect.left - layer.rect.left),
                            std::min(whole.end, frame_.rect.right - layer.rect.left)};
    if (span.begin >= span.end) continue;
    if (layer.opaque && !row(y).edged) {
      layOpaque(layer, line, span);
    } else {
      lay({layer.rect.left + span.begin, y, layer.rect.left + span.end, y + 1}, layer.colourRow(line) + span.begin,
          layer.depthRow(line) + span.begin, layer.width());
    }
  }
}

void FrameBuilder::layOpaque(const raster::Image& layer, int line, const raster::Span& span) {
  const int y = layer.rect.top + line;
  const int width = span.end - span.begin;
  const std::uint32_t* const colour = layer.colourRow(line) + span.begin;
  const float* const depth = layer.depthRow(line) + span.begin;
  if (!row(y).touched && width == frame_.width()) {
    std::copy_n(colour, width, frame_.colourRow(this->line(y)));
    std::copy_n(depth, width, frame_.depthRow(this->line(y)));
    row(y).touched = true;
  } else {
    clear(y);
    compositeOpaque({colour, depth, layer.width()}, pixels(layer.rect.left + span.begin, y), width, 1);
  }
}

void FrameBuilder::lay(const world::Rect& rect, const std::uint32_t* colour, const float* depth,
                       std::ptrdiff_t stride) {
  if (rect.empty()) return;
  assert(rect.left >= frame_.rect.left && rect.right <= frame_.rect.right && clip(rect) == rect);
  for (int y = rect.top; y < rect.bottom; ++y) {
    clear(y);
    bool& edged = row(y).edged;
    if (!edged) std::fill_n(edges_.depthRow(y - edges_.rect.top), edges_.width(), kNoEdge);
    edged = true;
  }
  composite({colour, depth, stride}, pixels(rect.left, rect.top), rect.width(), rect.height());
}

bool FrameBuilder::hides(const world::Rect& rect, float depth) const {
  if (rect.empty()) return true;
  for (int y = rect.top; y < rect.bottom; ++y) {
    if (!row(y).touched) return false;
  }
  return allNearer(frame_.depthRow(line(rect.top)) + (rect.left - frame_.rect.left), frame_.width(), rect.width(),
                   rect.height(), depth);
}

void FrameBuilder::finish() {
  for (int y = edges_.rect.top; y < edges_.rect.bottom; ++y) {
    clear(y);
    bool& edged = row(y).edged;
    if (edged) layEdges(pixels(frame_.rect.left, y), frame_.width());
    edged = false;
  }
}

FramePixels FrameBuilder::pixels(int x, int y) const {
  const int column = x - frame_.rect.left;
  const int edge = y - edges_.rect.top;
  return {frame_.colourRow(line(y)) + column, frame_.depthRow(line(y)) + column, edges_.colourRow(edge) + column,
          edges_.depthRow(edge) + column, frame_.width()};
}

void FrameBuilder::clear(int y) {
  bool& touched = row(y).touched;
  if (touched) return;
  std::fill_n(frame_.colourRow(line(y)), frame_.width(), kOpaqueBlack);
  std::fill_n(frame_.depthRow(line(y)), frame_.width(), world::kInfiniteDepth);
  touched = true;
}

}  // namespace grove::node
