#pragma once

#include <memory>
#include <mutex>

#include "node/frontend/backdrops/backdrop.h"
#include "node/frontend/frames/redraw_turns.h"

namespace grove::node {

/// A visitor's newest backdrop: the Compositor draws it, the BackdropPlanner evaluates it. Any thread.
class BackdropStore {
 public:
  /// The process's visitors share `turns`, which outlives it.
  explicit BackdropStore(RedrawTurns& turns) : turn_(turns) {}

  /// Null before the first.
  [[nodiscard]] std::shared_ptr<const Backdrop> newest() const;
  /// Ends the visitor's turn.
  void put(std::shared_ptr<const Backdrop> backdrop);
  /// The visitor's turn to draw the next one.
  [[nodiscard]] RedrawTurn& turn() noexcept { return turn_; }

 private:
  RedrawTurn turn_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Backdrop> newest_;
};

}  // namespace grove::node
