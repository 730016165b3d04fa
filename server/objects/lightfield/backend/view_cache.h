#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/view_cell.h"
#include "pipeline/memory_ledger.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// What a cached view shows.
struct ViewKey {
  world::ObjectId object = 0;
  CellId cell;
  friend bool operator==(const ViewKey&, const ViewKey&) = default;
};

/// Views that all visitors share, the least recently used given up first. Any thread.
///
/// Never holds more than `mostBytes`, not for a moment. A view that was given up lives on, uncounted, as long as
/// somebody draws it.
class ViewCache {
 public:
  /// 0 keeps nothing. `memory` is told what is kept.
  ViewCache(std::size_t mostBytes, pipeline::MemoryLedger& memory);

  /// Null if it is not there. Counts a hit or a miss.
  [[nodiscard]] std::shared_ptr<const CachedView> find(const ViewKey& key);

  /// Keeps a view that was missed and returns the one to draw: if another visitor was quicker, his.
  [[nodiscard]] std::shared_ptr<const CachedView> keep(const ViewKey& key, std::shared_ptr<const CachedView> view);

  struct Statistics {
    std::uint64_t hits = 0;
    std::uint64_t misses = 0;
    std::size_t bytes = 0;
    std::size_t entries = 0;
  };
  [[nodiscard]] Statistics statistics() const;
  [[nodiscard]] std::size_t mostBytes() const noexcept { return mostBytes_; }

 private:
  struct Hash {
    std::size_t operator()(const ViewKey& key) const noexcept;
  };
  struct Entry {
    ViewKey key;
    std::shared_ptr<const CachedView> view;
  };

  const std::size_t mostBytes_;
  mutable std::mutex mutex_;
  std::list<Entry> entries_;  // the most recently used first
  std::unordered_map<ViewKey, std::list<Entry>::iterator, Hash> places_;
  std::uint64_t hits_ = 0;
  std::uint64_t misses_ = 0;
  std::size_t bytes_ = 0;
  pipeline::HeldMemory held_;
};

}  // namespace grove::objects::lightfield
