#include "objects/fluid/backend/solver/ghosts.h"

#include <algorithm>

namespace grove::objects::fluid {

namespace {

/// Ghosts below 0 and above the last value of an axis: the nearest value or 0.
struct Outside {
  bool lowIsZero = false;
  bool highIsZero = false;
  int count = 0;        ///< values along the axis
  int ghostsAbove = 0;  ///< 1 or 2
};

/// Fills the ghosts at both ends of every row.
void fillRowEnds(const Layout& layout, Field& field, const Outside& outside) {
  const int last = layout.cells + 1;
  for (int z = -1; z <= last; ++z) {
    for (int y = -1; y <= last; ++y) {
      float* row = field.data() + layout.index(0, y, z);
      float* end = row + outside.count;
      row[-1] = outside.lowIsZero ? 0.0F : row[0];
      const float high = outside.highIsZero ? 0.0F : end[-1];
      for (int k = 0; k < outside.ghostsAbove; ++k) end[k] = high;
    }
  }
}

/// Ghosts of the other axes are whole rows.
void fillRows(const Layout& layout, Field& field, int axis, const Outside& outside) {
  const int last = layout.cells + 1;
  const auto length = static_cast<std::size_t>(last + 2);
  const auto fill = [&](const float* from, bool isZero, float* to) {
    if (isZero) {
      std::fill_n(to, length, 0.0F);
    } else {
      std::copy_n(from, length, to);
    }
  };
  const std::ptrdiff_t step = layout.step(axis);
  for (int j = -1; j <= last; ++j) {
    float* low = field.data() + (axis == 1 ? layout.index(-1, 0, j) : layout.index(-1, j, 0));
    float* high = low + step * (outside.count - 1);
    fill(low, outside.lowIsZero, low - step);
    for (int k = 1; k <= outside.ghostsAbove; ++k) fill(high, outside.highIsZero, high + step * k);
  }
}

void fillGhosts(const Layout& layout, Field& field, int axis, const Outside& outside) {
  if (axis == 0) {
    fillRowEnds(layout, field, outside);
  } else {
    fillRows(layout, field, axis, outside);
  }
}

}  // namespace

void fillVelocityGhosts(const Layout& layout, const Sides& sides, Velocity& velocity) {
  const int n = layout.cells;
  for (int component = 0; component < 3; ++component) {
    for (int a = 0; a < 3; ++a) {
      const bool across = a == component;
      fillGhosts(layout, velocity.axis(component), a,
                 {across && !sides.open(a, false), across && !sides.open(a, true), across ? n + 1 : n, across ? 1 : 2});
    }
  }
}

void fillCentreGhosts(const Layout& layout, const Sides& sides, Field& field) {
  for (int a = 0; a < 3; ++a) {
    fillGhosts(layout, field, a, {sides.open(a, false), sides.open(a, true), layout.cells, 2});
  }
}

}  // namespace grove::objects::fluid
