#include "stream/late_walk/nearness_grid.h"

#include <algorithm>
#include <cmath>

namespace grove::stream {
namespace {

constexpr int kMerged = NearnessGrid::kCell / node::CellNearness::kCell;

/// Difference in nearness that makes a silhouette, 1 / metres.
constexpr float kSilhouette = 0.02F;

std::uint8_t toStep(float nearness) {
  return static_cast<std::uint8_t>(std::lround(std::min(nearness / NearnessGrid::kStep, float{NearnessGrid::kMax})));
}

}  // namespace

NearnessGrid::NearnessGrid(int width, int height)
    : across((width + kCell - 1) / kCell),
      down((height + kCell - 1) / kCell),
      values(static_cast<std::size_t>(across) * static_cast<std::size_t>(down)) {}

NearnessGrid::NearnessGrid(const node::CellNearness& cells)
    : NearnessGrid(cells.across() * node::CellNearness::kCell, cells.down() * node::CellNearness::kCell) {
  std::size_t next = 0;
  for (int row = 0; row < down; ++row) {
    const auto upper = cells.row(kMerged * row);
    const auto lower = cells.row(std::min(kMerged * row + 1, cells.down() - 1));
    for (int column = 0; column < across; ++column) {
      const std::size_t left = std::size_t{kMerged} * static_cast<std::size_t>(column);
      const std::size_t right = std::min(left + 1, upper.size() - 1);
      const auto [least, most] = std::minmax({upper[left], upper[right], lower[left], lower[right]});
      const float mean = 0.25F * (upper[left] + upper[right] + lower[left] + lower[right]);
      values[next++] = toStep(most - least > kSilhouette ? most : mean);
    }
  }
}

}  // namespace grove::stream
