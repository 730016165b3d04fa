#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "objects/lightfield/common/cross_fade.h"
#include "objects/lightfield/common/view_cell.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// The last shared picture of each object that a visitor was shown. Reusing it as long as it is good enough saves new
/// pictures, and when the budget is spent it is the only choice. Any thread.
class LastViews {
 public:
  /// The cell of the last shown picture.
  [[nodiscard]] std::optional<CellId> last(world::ObjectId object) const;

  /// Records the picture shown at a time of the world clock. If it belongs to a finer light field than `former`, starts
  /// a cross-fade of CrossFade::kSeconds from `former`; null: no cross-fade.
  void shown(world::ObjectId object, const CellId& cell, double time, std::shared_ptr<const CachedView> former);

  /// The cross-fade to the newest picture.
  [[nodiscard]] CrossFade fade(world::ObjectId object, double time) const;

  /// Ends the cross-fade immediately.
  void endFade(world::ObjectId object);

 private:
  struct Entry {
    CellId cell;
    std::shared_ptr<const CachedView> former;  ///< of the former light field
    double since = 0.0;                        ///< first time with a cell of the new light field
  };
  mutable std::mutex mutex_;
  std::map<world::ObjectId, Entry> entries_;
};

}  // namespace grove::objects::lightfield
