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

void ScanConverter::convert(int firstRow, SpanRows& rows) const noexcept {
  const Floats y = toFloats(kUpwards + firstRow) + 0.5F;
  const Floats low = static_cast<float>(limits_.left) - Floats{};
  const Floats high = static_cast<float>(limits_.right) - Floats{};
  // The first column whose middle is not before where an edge crosses the middle of a row.
  const auto columns = [&](const Edge& edge) {
    const Floats column = clamped(edge.x + (y - edge.top) * edge.slope - 0.5F, low, high);
    const Ints cut = truncated(column);
    return cut - (toFloats(cut) < column);
  };
  const Ints straight = columns(long_);
  const Ints bent = kUpwards + firstRow < middle_ ? columns(upper_) : columns(lower_);
  rows.begin = longIsLeft_ ? straight : bent;
  rows.end = longIsLeft_ ? bent : straight;
}

}  // namespace grove::objects::mesh
