#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "node/messages.h"
#include "objects/lightfield/cache/cached_view.h"
#include "objects/lightfield/cache/view_cell.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// Keeps a frame from making many new pictures at once. A visitor who walks leaves the cells of many objects in the
/// same frame; a machine that is late for it would find all of them left again in the next, and be later still. So only
/// some are made at once, and the others are shown once more with the picture that this visitor saw last, whose error
/// is then up to kLateness times the permitted one.
///
/// Remembers the last pictures without keeping them alive, of the visitors and objects used last. Any thread.
class LateViews {
 public:
  static constexpr int kMostNewPictures = 3;  ///< in one frame
  static constexpr float kLateness = 3.0F;

  /// The picture to show once more, for a request whose cell has none yet; null if a new one is to be made.
  [[nodiscard]] std::shared_ptr<const CachedView> lateView(const node::View& view, world::ObjectId object,
                                                           const ViewCell& cell, world::Vec3 eye);

  /// What the visitor was shown.
  void shown(const node::View& view, world::ObjectId object, const std::shared_ptr<const CachedView>& picture);

 private:
  static constexpr std::size_t kMostEntries = 8192;
  using Key = std::pair<node::SessionId, world::ObjectId>;
  struct Entry {
    Key key;
    std::weak_ptr<const CachedView> picture;
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
