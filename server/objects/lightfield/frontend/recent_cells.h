#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

#include "objects/lightfield/common/view_cell.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// The cells of the newest shared pictures of each object, for all visitors of a frontend process: who sees an object for
/// the first time begins with a picture that somebody else needed. Any thread.
class RecentCells {
 public:
  /// A new picture of this cell has arrived.
  void add(world::ObjectId object, const CellId& cell);
  /// Returns at most kMax cells, the oldest first. Their pictures may have been dropped since.
  [[nodiscard]] std::vector<CellId> of(world::ObjectId object) const;

  static constexpr std::size_t kMax = 16;

 private:
  mutable std::mutex mutex_;
  std::map<world::ObjectId, std::vector<CellId>> cells_;
};

}  // namespace grove::objects::lightfield
