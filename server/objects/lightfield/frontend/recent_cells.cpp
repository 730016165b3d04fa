#include "objects/lightfield/frontend/recent_cells.h"

#include <algorithm>

namespace grove::objects::lightfield {

void RecentCells::add(world::ObjectId object, const CellId& cell) {
  const std::lock_guard lock(mutex_);
  std::vector<CellId>& cells = cells_[object];
  std::erase(cells, cell);
  if (cells.size() == kMax) cells.erase(cells.begin());
  cells.push_back(cell);
}

std::vector<CellId> RecentCells::of(world::ObjectId object) const {
  const std::lock_guard lock(mutex_);
  const auto found = cells_.find(object);
  return found == cells_.end() ? std::vector<CellId>() : found->second;
}

}  // namespace grove::objects::lightfield
