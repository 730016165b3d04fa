#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "node/messages/cell_nearness.h"

namespace grove::stream {

/// How near the surfaces of a picture are, for pages that move pictures to where their visitor is by now (late walk):
/// one value per cell of 16 x 16 pixels, row by row.
struct NearnessGrid {
  /// Pixels of a cell's side. Cells at the picture's right and bottom may reach beyond it.
  static constexpr int kCell = 16;
  /// Values are 1 / view depth in steps of this, 1 / metres. 0 is infinitely far.
  static constexpr float kStep = 1.0F / 64.0F;
  /// The largest value.
  static constexpr int kMax = 127;

  int across = 0;
  int down = 0;
  std::vector<std::uint8_t> values;

  /// Values of a picture of this size are all 0.
  NearnessGrid(int width, int height);
  /// Takes the nearest of four cells where they differ much, so that silhouettes move with the nearer surface, and else
  /// their mean.
  explicit NearnessGrid(const node::CellNearness& cells);

  friend bool operator==(const NearnessGrid&, const NearnessGrid&) = default;
};

}  // namespace grove::stream
