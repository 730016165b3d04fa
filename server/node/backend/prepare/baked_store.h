#pragma once

#include <any>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "pipeline/memory_ledger.h"

namespace grove::node {

/// Data that backend halves baked from a world's layout alone, for further copies of the same world: in private mode
/// only the first visitor's world is baked. Each world still holds its own copy, as on a machine of its own. Any
/// thread.
class BakedStore {
 public:
  explicit BakedStore(pipeline::MemoryLedger& memory) : held_(memory, "baked", "", pipeline::Work::kAcrossUser) {}

  /// Returns a copy of the data under `key`, always of one type; bakes the data first if there is none. `bytes` returns
  /// its size.
  template <class Baked, class Bytes, class Bake>
  [[nodiscard]] Baked copyOf(const std::string& key, const Bytes& bytes, const Bake& bake) {
    if (const auto kept = find(key)) return *std::any_cast<Baked>(kept.get());
    Baked made = bake();
    keep(key, std::make_shared<const std::any>(made), bytes(made));
    return made;
  }

 private:
  [[nodiscard]] std::shared_ptr<const std::any> find(const std::string& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = kept_.find(key);
    return found == kept_.end() ? nullptr : found->second;
  }

  void keep(const std::string& key, const std::shared_ptr<const std::any>& baked, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (!kept_.try_emplace(key, baked).second) return;
    bytes_ += bytes;
    held_.set(bytes_);
  }

  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const std::any>> kept_;
  std::size_t bytes_ = 0;
  pipeline::HeldMemory held_;
};

}  // namespace grove::node
