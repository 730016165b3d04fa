#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "node/messages.h"
#include "objects/lightfield/common/cross_fade.h"
#include "objects/lightfield/common/view_cell.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// Remembers which picture of each object a visitor was shown last: going on with it as long as it serves takes fewer
/// new ones, and when there is no time for those it is all there is. Forgets the visitors and objects used least
/// recently. Any thread.
class LateViews {
 public:
  /// The cell whose picture this visitor was shown last.
  [[nodiscard]] std::optional<CellId> last(const node::View& view, world::ObjectId object);

  /// What gave way to a picture of a finer light field less than CrossFade::kSeconds ago.
  struct Fading {
    CellId from;
    float share = 0.0F;  ///< of the finer one
  };
  [[nodiscard]] std::optional<Fading> fading(const node::View& view, world::ObjectId object);

  /// What the visitor was shown.
  void shown(const node::View& view, world::ObjectId object, const CellId& cell);

 private:
  static constexpr std::size_t kMostEntries = 8192;
  using Key = std::pair<node::SessionId, world::ObjectId>;
  struct Entry {
    Key key;
    CellId cell;
    CellId from = {};    ///< of the former light field
    double since = 0.0;  ///< when `cell` was first of another light field than `from`
  };

  std::mutex mutex_;
  std::list<Entry> entries_;  // the last used first
  std::map<Key, std::list<Entry>::iterator> places_;
};

}  // namespace grove::objects::lightfield
