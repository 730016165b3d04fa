#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "node/messages.h"
#include "objects/lightfield/cache/view_cell.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// Remembers which picture of each object a visitor was shown last, and keeps a frame from making many new ones at
/// once. A visitor who walks leaves the cells of many objects in the same frame; a machine that is late for it would
/// find all of them left again in the next, and be later still. So only some are made at once, and the others are shown
/// once more with the last picture, whose error is then up to kLateness times the permitted one.
///
/// Forgets the visitors and objects used least recently. Any thread.
class LateViews {
 public:
  static constexpr int kMostNewPictures = 2;  ///< in one frame
  static constexpr float kLateness = 3.0F;

  /// The cell whose picture this visitor was shown last.
  [[nodiscard]] std::optional<CellId> last(const node::View& view, world::ObjectId object);

  /// Whether this frame may make one more picture; counts it.
  [[nodiscard]] bool mayMake(const node::View& view);

  /// What the visitor was shown.
  void shown(const node::View& view, world::ObjectId object, const CellId& cell);

 private:
  static constexpr std::size_t kMostEntries = 8192;
  using Key = std::pair<node::SessionId, world::ObjectId>;
  struct Entry {
    Key key;
    CellId cell;
  };
  struct Budget {
    node::FrameNumber frame = 0;
    int made = 0;
  };

  std::mutex mutex_;
  std::list<Entry> entries_;  // the last used first
  std::map<Key, std::list<Entry>::iterator> places_;
  std::map<node::SessionId, Budget> budgets_;
};

}  // namespace grove::objects::lightfield
