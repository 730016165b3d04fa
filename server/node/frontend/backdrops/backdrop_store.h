#pragma once

#include <memory>
#include <mutex>

#include "node/frontend/backdrops/backdrop.h"

namespace grove::node {

/// A visitor's newest backdrop: the Compositor draws it, the BackdropPlanner evaluates it. Any thread.
class BackdropStore {
 public:
  /// Null before the first.
  [[nodiscard]] std::shared_ptr<const Backdrop> newest() const;
  void put(std::shared_ptr<const Backdrop> backdrop);

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const Backdrop> newest_;
};

}  // namespace grove::node
