#include "node/messages/cell_nearness.h"

#include <algorithm>
#include <cassert>

namespace grove::node {
namespace {

/// Anything at or beyond this depth counts as infinitely far.
constexpr float kFarthestDepth = 1.0e29F;

/// Columns and rows of a cell's four samples.
constexpr int kFirst = 2;
constexpr int kSecond = 5;

int cellsFor(int pixels) { return (pixels + CellNearness::kCell - 1) / CellNearness::kCell; }

}  // namespace

CellNearness::CellNearness(int width, int height, raster::ImagePool& images)
    : across_(cellsFor(width)),
      down_(cellsFor(height)),
      memory_(images.acquireBytes(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_) * sizeof(float))),
      cells_(reinterpret_cast<float*>(memory_.bytes.data()), memory_.bytes.size() / sizeof(float)) {}

void CellNearness::measure(const raster::Image& frame, const world::Rect& part) {
  assert(frame.rect.left == 0 && frame.rect.top == 0 && overlap(frame.rect, part) == part);
  assert(part.left % kCell == 0 && part.top % kCell == 0);
  // Cells may reach beyond the frame.
  const auto sample = [](int place, int size) { return std::min(place, size - 1); };
  for (int top = part.top; top < part.bottom; top += kCell) {
    const float* const upper = frame.depthRow(sample(top + kFirst, frame.height()));
    const float* const lower = frame.depthRow(sample(top + kSecond, frame.height()));
    float* cell = row(top / kCell).data() + part.left / kCell;
    for (int left = part.left; left < part.right; left += kCell) {
      const int first = sample(left + kFirst, frame.width());
      const int second = sample(left + kSecond, frame.width());
      const float depth = std::min(std::min(upper[first], upper[second]), std::min(lower[first], lower[second]));
      *cell++ = depth < kFarthestDepth ? 1.0F / depth : 0.0F;
    }
  }
}

}  // namespace grove::node
