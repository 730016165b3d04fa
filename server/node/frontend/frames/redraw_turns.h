#pragma once

#include <algorithm>
#include <atomic>

namespace grove::node {

/// Number of backdrops that a process's visitors are drawing. Visitors of a busy machine take turns, because several
/// backdrops drawn at the same time delay every visitor's frames. Any thread.
class RedrawTurns {
 public:
  explicit RedrawTurns(int workers) : atOnce_(std::max(workers / 2, 1)) {}

  [[nodiscard]] bool isFree() const noexcept { return drawing_ < atOnce_; }

 private:
  friend class RedrawTurn;
  const int atOnce_;
  std::atomic<int> drawing_{0};
};

/// One visitor's turn. Any thread.
class RedrawTurn {
 public:
  explicit RedrawTurn(RedrawTurns& turns) : turns_(turns) {}
  ~RedrawTurn() { end(); }
  RedrawTurn(const RedrawTurn&) = delete;
  RedrawTurn& operator=(const RedrawTurn&) = delete;

  /// The visitor's backdrop is being drawn from begin() until end().
  void begin() noexcept {
    if (!isTaken_.exchange(true)) ++turns_.drawing_;
  }
  void end() noexcept {
    if (isTaken_.exchange(false)) --turns_.drawing_;
  }
  /// Whether too many other visitors' backdrops are being drawn.
  [[nodiscard]] bool isOthers() const noexcept { return !isTaken_ && !turns_.isFree(); }

 private:
  RedrawTurns& turns_;
  std::atomic<bool> isTaken_{false};
};

}  // namespace grove::node
