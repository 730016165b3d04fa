#include "node/frontend/compositing/fresh_parts.h"

#include <algorithm>

namespace grove::node {
namespace {

int stripsFor(int pixels, int side) { return (pixels + side - 1) / side; }

}  // namespace

FreshParts::FreshParts(const world::Rect& frame, const std::vector<world::Rect>& drawn)
    : frame_(frame),
      across_(stripsFor(frame.width(), kStripWidth)),
      fresh_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(stripsFor(frame.height(), kStripHeight))) {
  for (const world::Rect& each : drawn) {
    const world::Rect part = world::overlap(frame, each).moved(-frame.left, -frame.top);
    if (part.empty()) continue;
    for (int row = part.top / kStripHeight; row * kStripHeight < part.bottom; ++row) {
      for (int column = part.left / kStripWidth; column * kStripWidth < part.right; ++column) {
        fresh_[indexOf(column, row)] = true;
      }
    }
  }
}

std::size_t FreshParts::indexOf(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(column);
}

bool FreshParts::isFresh(int left, int top) const {
  return fresh_[indexOf((left - frame_.left) / kStripWidth, (top - frame_.top) / kStripHeight)];
}

std::vector<raster::Span> FreshParts::spans() const {
  std::vector<raster::Span> spans(static_cast<std::size_t>(frame_.height()), {frame_.width(), 0});
  for (const world::Rect& strip : strips()) {
    for (int y = strip.top; y < strip.bottom; ++y) {
      raster::Span& span = spans[static_cast<std::size_t>(y - frame_.top)];
      span = {std::min(span.begin, strip.left - frame_.left), std::max(span.end, strip.right - frame_.left)};
    }
  }
  return spans;
}

std::vector<world::Rect> FreshParts::strips() const {
  std::vector<world::Rect> strips;
  for (int top = frame_.top; top < frame_.bottom; top += kStripHeight) {
    bool continues = false;
    for (int left = frame_.left; left < frame_.right; left += kStripWidth) {
      const bool fresh = isFresh(left, top);
      const int right = std::min(left + kStripWidth, frame_.right);
      if (fresh && continues) {
        strips.back().right = right;
      } else if (fresh) {
        strips.push_back({left, top, right, std::min(top + kStripHeight, frame_.bottom)});
      }
      continues = fresh;
    }
  }
  return strips;
}

}  // namespace grove::node
