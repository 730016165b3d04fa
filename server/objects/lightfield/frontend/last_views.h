#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "objects/lightfield/common/cross_fade.h"
#include "objects/lightfield/common/view_cell.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// Remembers which shared picture of each object a visitor was shown last: going on with it as long as it serves takes
/// fewer new ones, and when there is no time for those it is all there is. Any thread.
class LastViews {
 public:
  /// The cell whose picture the visitor was shown last.
  [[nodiscard]] std::optional<CellId> last(world::ObjectId object) const;

  /// What the visitor is shown at a time of the world's clock. If it is of a finer light field than `former`, that
  /// gives way to it within CrossFade::kSeconds; null: there is nothing to give way.
  void shown(world::ObjectId object, const CellId& cell, double time, std::shared_ptr<const CachedView> former);

  /// What gives way to the newest picture.
  [[nodiscard]] CrossFade fade(world::ObjectId object, double time) const;

  /// What gave way is to be seen no more.
  void endFade(world::ObjectId object);

 private:
  struct Entry {
    CellId cell;
    std::shared_ptr<const CachedView> former;  ///< of the former light field
    double since = 0.0;                        ///< when `cell` was first of another light field
  };
  mutable std::mutex mutex_;
  std::map<world::ObjectId, Entry> entries_;
};

}  // namespace grove::objects::lightfield
