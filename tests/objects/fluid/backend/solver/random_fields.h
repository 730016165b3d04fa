#pragma once

#include <cstdint>
#include <random>

#include "objects/fluid/backend/solver/grid.h"

namespace grove::objects::fluid {

/// A field of noise from -1 to 1, in its ghosts, too.
inline Field randomField(std::size_t size, std::mt19937& random) {
  Field field(size);
  for (std::size_t i = 0; i < size; ++i) {
    field[static_cast<std::ptrdiff_t>(i)] = static_cast<float>(random() % 20001) / 10000.0F - 1.0F;
  }
  return field;
}

template <class Visit>
void forEachCell(const Layout& layout, const Visit& visit) {
  for (int z = 0; z < layout.cells; ++z) {
    for (int y = 0; y < layout.cells; ++y) {
      for (int x = 0; x < layout.cells; ++x) visit(layout.index(x, y, z));
    }
  }
}

/// Noise in the cells that are air, zero elsewhere.
inline Field randomCells(const Layout& layout, const Array<std::uint8_t>& diagonal, std::mt19937& random) {
  const Field noise = randomField(layout.size(), random);
  Field field(layout.size());
  forEachCell(layout, [&](std::ptrdiff_t i) { field[i] = diagonal[i] != 0 ? noise[i] : 0.0F; });
  return field;
}

}  // namespace grove::objects::fluid
