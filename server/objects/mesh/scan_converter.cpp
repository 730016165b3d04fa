#include "objects/mesh/scan_converter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grove::objects::mesh {
namespace {

/// The first row or column, from `low` up to `high`, whose middle is not before a coordinate.
int firstFrom(float coordinate, int low, int high) noexcept {
  return static_cast<int>(std::ceil(std::clamp(coordinate - 0.5F, static_cast<float>(low), static_cast<float>(high))));
}

std::array<ScreenPoint, 3> fromTop(ScreenPoint a, ScreenPoint b, ScreenPoint c) noexcept {
  if (b.y < a.y) std::swap(a, b);
  if (c.y < b.y) std::swap(b, c);
  if (b.y < a.y) std::swap(a, b);
  return {a, b, c};
}

}  // namespace

ScanConverter::Edge::Edge(ScreenPoint from, ScreenPoint to) noexcept
    : x(from.x), top(from.y), slope(to.y > from.y ? (to.x - from.x) / (to.y - from.y) : 0.0F) {}

ScanConverter::ScanConverter(ScreenPoint a, ScreenPoint b, ScreenPoint c, const world::Rect& limits) noexcept
    : long_(a, a), upper_(a, a), lower_(a, a), limits_(limits) {
  const auto [first, second, third] = fromTop(a, b, c);
  long_ = Edge(first, third);
  upper_ = Edge(first, second);
  lower_ = Edge(second, third);
  longIsLeft_ = (second.x - first.x) * (third.y - first.y) > (third.x - first.x) * (second.y - first.y);
  top_ = firstFrom(first.y, limits.top, limits.bottom);
  middle_ = firstFrom(second.y, limits.top, limits.bottom);
  bottom_ = firstFrom(third.y, limits.top, limits.bottom);
}

void ScanConverter::convert(int firstRow, std::span<node::Span> rows) const noexcept {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int row = firstRow + static_cast<int>(i);
    const float middle = static_cast<float>(row) + 0.5F;
    const int along = firstFrom(long_.at(middle), limits_.left, limits_.right);
    const int across = firstFrom((row < middle_ ? upper_ : lower_).at(middle), limits_.left, limits_.right);
    rows[i] = longIsLeft_ ? node::Span{along, across} : node::Span{across, along};
  }
}

}  // namespace grove::objects::mesh
