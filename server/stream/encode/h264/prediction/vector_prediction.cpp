#include "stream/encode/h264/prediction/vector_prediction.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace grove::stream::h264 {
namespace {

/// An 8 x 8 block beside the one whose vector is expected.
struct Neighbour {
  bool known = false;   ///< within the picture, and encoded before
  bool inter = false;   ///< has a vector
  MotionVector vector;  ///< zero if it has none
};

/// Names as in figure 6-12: left, above, above right, above left.
struct Neighbours {
  Neighbour a;
  Neighbour b;
  Neighbour c;
};

/// The block at a place in blocks of 8 x 8 pixels, in a macroblock before the one at column and row.
Neighbour earlier(const MacroblockGrid& grid, int column, int row, int x, int y) {
  if (x < 0 || y < 0 || x >= 2 * grid.across) return {};
  if (y / 2 == row && x / 2 >= column) return {};
  const Macroblock& macroblock = grid.at(x / 2, y / 2);
  return {true, !macroblock.intra, macroblock.vectors[static_cast<std::size_t>(y % 2 * 2 + x % 2)]};
}

std::int16_t median(std::int16_t a, std::int16_t b, std::int16_t c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

MotionVector expectedFrom(const Neighbours& of) {
  if (!of.b.known && !of.c.known && of.a.known) return of.a.vector;
  const int count = (of.a.inter ? 1 : 0) + (of.b.inter ? 1 : 0) + (of.c.inter ? 1 : 0);
  if (count == 1) return of.a.inter ? of.a.vector : of.b.inter ? of.b.vector : of.c.vector;
  return {median(of.a.vector.x, of.b.vector.x, of.c.vector.x), median(of.a.vector.y, of.b.vector.y, of.c.vector.y)};
}

Neighbours around(const MacroblockGrid& grid, int column, int row) {
  const auto at = [&](int x, int y) { return earlier(grid, column, row, 2 * column + x, 2 * row + y); };
  Neighbours found{at(-1, 0), at(0, -1), at(2, -1)};
  if (!found.c.known) found.c = at(-1, -1);
  return found;
}

}  // namespace

MotionVector expectedVector(const MacroblockGrid& grid, int column, int row) {
  return expectedFrom(around(grid, column, row));
}

MotionVector expectedVector(const MacroblockGrid& grid, int column, int row, int block,
                            const std::array<MotionVector, 4>& vectors) {
  const int left = block % 2;
  const int top = block / 2;
  const auto at = [&](int x, int y) -> Neighbour {
    const int column8 = left + x;
    const int row8 = top + y;
    const bool own = column8 >= 0 && column8 < 2 && row8 >= 0;
    if (!own) return earlier(grid, column, row, 2 * column + column8, 2 * row + row8);
    const int index = row8 * 2 + column8;
    if (index >= block) return {};
    return {true, true, vectors[static_cast<std::size_t>(index)]};
  };
  Neighbours found{at(-1, 0), at(0, -1), at(1, -1)};
  if (!found.c.known) found.c = at(-1, -1);
  return expectedFrom(found);
}

MotionVector skippedVector(const MacroblockGrid& grid, int column, int row, const MotionVector& expected) {
  const Neighbour a = earlier(grid, column, row, 2 * column - 1, 2 * row);
  const Neighbour b = earlier(grid, column, row, 2 * column, 2 * row - 1);
  const auto rests = [](const Neighbour& each) { return each.inter && each.vector == MotionVector{}; };
  if (!a.known || !b.known || rests(a) || rests(b)) return {};
  return expected;
}

}  // namespace grove::stream::h264
