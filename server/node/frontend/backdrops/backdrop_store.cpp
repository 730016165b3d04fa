#include "node/frontend/backdrops/backdrop_store.h"

#include <utility>

namespace grove::node {

std::shared_ptr<const Backdrop> BackdropStore::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

void BackdropStore::put(std::shared_ptr<const Backdrop> backdrop) {
  turn_.end();
  // The previous backdrop's memory is freed after the lock.
  const std::lock_guard lock(mutex_);
  std::swap(newest_, backdrop);
}

}  // namespace grove::node
