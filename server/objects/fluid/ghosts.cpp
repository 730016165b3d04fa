#include "objects/fluid/ghosts.h"

namespace grove::objects::fluid {

namespace {

/// Gives the ghosts below 0 and above the last of an axis values made by `outside(high, nearest)`.
template <class Outside>
void fillGhosts(const Layout& layout, Field& field, int axis, int count, int ghostsAbove, const Outside& outside) {
  const int last = layout.cells + 1;
  const std::ptrdiff_t step = layout.step(axis);
  for (int j = -1; j <= last; ++j) {
    for (int i = -1; i <= last; ++i) {
      const int x = axis == 0 ? 0 : i;
      const int y = axis == 1 ? 0 : axis == 0 ? i : j;
      const int z = axis == 2 ? 0 : j;
      const std::ptrdiff_t at = layout.index(x, y, z);
      field[at - step] = outside(false, field[at]);
      const std::ptrdiff_t end = at + step * (count - 1);
      for (int k = 1; k <= ghostsAbove; ++k) field[end + step * k] = outside(true, field[end]);
    }
  }
}

}  // namespace

void fillVelocityGhosts(const Layout& layout, const Sides& sides, Velocity& velocity) {
  const int n = layout.cells;
  for (int component = 0; component < 3; ++component) {
    for (int a = 0; a < 3; ++a) {
      const bool across = a == component;
      fillGhosts(layout, velocity.axis(component), a, across ? n + 1 : n, across ? 1 : 2,
                 [&](bool high, float nearest) { return across && !sides.open(a, high) ? 0.0F : nearest; });
    }
  }
}

void fillCentreGhosts(const Layout& layout, const Sides& sides, Field& field) {
  for (int a = 0; a < 3; ++a) {
    fillGhosts(layout, field, a, layout.cells, 2,
               [&](bool high, float nearest) { return sides.open(a, high) ? 0.0F : nearest; });
  }
}

}  // namespace grove::objects::fluid
