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
  float upper = top;
  float upperColumn = columnAt(top);
  for (int row = static_cast<int>(top); static_cast<float>(row) < bottom; ++row) {
    const float lower = std::min(bottom, static_cast<float>(row + 1));
    const float lowerColumn = columnAt(lower);
    addInRow(row, upperColumn, lowerColumn, sign * (lower - upper));
    upper = lower;
    upperColumn = lowerColumn;
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
  // Most edges cross few rows in more than one column: the others need no division.
  if (left >= 0.0F && right < width && static_cast<int>(left) == static_cast<int>(right)) {
    const int column = static_cast<int>(left);
    cells_.push_back({row, column, height, height * (static_cast<float>(column + 1) - 0.5F * (left + right))});
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
  // Rows have few cells each, so that sorting all of them by columns first is cheaper than each row by itself.
  sortBy([](const Cell& cell) { return cell.column + 1; }, rect_.width() + 1, cells_, sorted_);
  sortBy([](const Cell& cell) { return cell.row; }, rect_.height(), sorted_, cells_);
  const std::span<const Cell> cells(cells_);
  for (std::size_t begin = 0; begin < cells.size();) {
    std::size_t end = begin + 1;
    while (end < cells.size() && cells[end].row == cells[begin].row) ++end;
    sweep(cells[begin].row, cells.subspan(begin, end - begin));
    begin = end;
  }
  return partly_;
}

template <class Key>
void EdgeCoverage::sortBy(const Key& key, int keys, const std::vector<Cell>& from, std::vector<Cell>& to) {
  starts_.assign(static_cast<std::size_t>(keys) + 1, 0);
  for (const Cell& cell : from) ++starts_[static_cast<std::size_t>(key(cell)) + 1];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  to.resize(from.size());
  for (const Cell& cell : from) to[starts_[static_cast<std::size_t>(key(cell))]++] = cell;
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

std::size_t EdgeCoverage::bytes() const noexcept { return pipeline::vectorBytes(cells_, sorted_, starts_, partly_); }

}  // namespace grove::raster
