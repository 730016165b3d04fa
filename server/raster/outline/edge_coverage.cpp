#include "raster/outline/edge_coverage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/vector_bytes.h"

namespace grove::raster {
namespace {

/// Half a step of an 8-bit share, which is more than the rounding errors of a row's sum.
constexpr float kNothing = 1.0F / 500.0F;

}  // namespace

void EdgeCoverage::begin(const world::Rect& rect) {
  rect_ = rect;
  cells_.clear();
}

void EdgeCoverage::add(world::Vec2 from, world::Vec2 to) {
  const float sign = to.y > from.y ? 1.0F : -1.0F;
  // Always in the same direction, so that two polygons' opposite edges add up to exactly nothing.
  if (sign < 0.0F) std::swap(from, to);
  const world::Vec2 corner(rect_.left, rect_.top);
  from -= corner;
  to -= corner;
  const float top = std::max(from.y, 0.0F);
  const float bottom = std::min(to.y, static_cast<float>(rect_.height()));
  if (!(top < bottom)) return;
  const float slope = (to.x - from.x) / (to.y - from.y);
  const auto columnAt = [&](float y) { return from.x + (y - from.y) * slope; };
  for (int row = static_cast<int>(top); static_cast<float>(row) < bottom; ++row) {
    const float upper = std::max(top, static_cast<float>(row));
    const float lower = std::min(bottom, static_cast<float>(row + 1));
    addInRow(row, columnAt(upper), columnAt(lower), sign * (lower - upper));
  }
}

void EdgeCoverage::addInRow(int row, float from, float to, float height) {
  float left = std::min(from, to);
  const float right = std::max(from, to);
  const auto width = static_cast<float>(rect_.width());
  if (!(left < width)) return;
  if (right <= 0.0F) {
    cells_.push_back({row, -1, height, 0.0F});
    return;
  }
  const float perColumn = right > left ? height / (right - left) : 0.0F;
  if (left < 0.0F) {
    cells_.push_back({row, -1, -left * perColumn, 0.0F});
    height += left * perColumn;
    left = 0.0F;
  }
  const int last = static_cast<int>(std::min(right, width - 1.0F));
  for (int column = static_cast<int>(left); column <= last; ++column) {
    const float begin = std::max(left, static_cast<float>(column));
    const float end = std::min(right, static_cast<float>(column + 1));
    const float part = perColumn != 0.0F ? (end - begin) * perColumn : height;
    cells_.push_back({row, column, part, part * (static_cast<float>(column + 1) - 0.5F * (begin + end))});
  }
}

const std::vector<CoveredPixels>& EdgeCoverage::partly() {
  partly_.clear();
  sortByRows();
  for (std::size_t row = 0; row + 1 < rowStarts_.size(); ++row) {
    const std::span<Cell> cells(sorted_.data() + rowStarts_[row], rowStarts_[row + 1] - rowStarts_[row]);
    std::ranges::sort(cells, {}, &Cell::column);
    sweep(static_cast<int>(row), cells);
  }
  return partly_;
}

void EdgeCoverage::sortByRows() {
  rowStarts_.assign(static_cast<std::size_t>(rect_.height()) + 2, 0);
  for (const Cell& cell : cells_) ++rowStarts_[static_cast<std::size_t>(cell.row) + 2];
  for (std::size_t i = 2; i < rowStarts_.size(); ++i) rowStarts_[i] += rowStarts_[i - 1];
  sorted_.resize(cells_.size());
  for (const Cell& cell : cells_) sorted_[rowStarts_[static_cast<std::size_t>(cell.row) + 1]++] = cell;
  rowStarts_.pop_back();
}

void EdgeCoverage::sweep(int row, std::span<const Cell> cells) {
  float height = 0.0F;
  for (std::size_t i = 0; i < cells.size();) {
    const int column = cells[i].column;
    float area = height;
    for (; i < cells.size() && cells[i].column == column; ++i) {
      area += cells[i].area;
      height += cells[i].height;
    }
    if (column >= 0) report(row, column, column + 1, area);
    report(row, column + 1, i < cells.size() ? cells[i].column : rect_.width(), height);
  }
}

void EdgeCoverage::report(int row, int begin, int end, float share) {
  if (begin < end && share > kNothing && share < 1.0F - kNothing) partly_.push_back({row, begin, end, share});
}

std::size_t EdgeCoverage::bytes() const noexcept { return pipeline::vectorBytes(cells_, sorted_, rowStarts_, partly_); }

}  // namespace grove::raster
