#pragma once

#include <deque>
#include <functional>
#include <mutex>

namespace grove::stream {

/// Lets a frame begin when a worker is idle; others wait for their turn, first come, first served. So a busy machine
/// finishes frames one after the other. If all began at once, each would take as long as all of them together, and show
/// a camera as old as that. Thread-safe.
class FrameGate {
 public:
  /// `places`: maximum number of frames in progress.
  explicit FrameGate(int places) : free_(places) {}

  /// Returns whether the caller takes the place.
  using OnTurn = std::function<bool()>;

  /// Returns true if the caller has a place. Otherwise calls `onTurn` as soon as there is one, on the thread that
  /// leaves or becomes idle, without a lock of the gate. Each taken place must be returned by leave().
  [[nodiscard]] bool enter(OnTurn onTurn);
  void leave();

  /// A worker becomes idle, or busy again.
  void workerIs(bool idle);

 private:
  void admitOne();

  std::mutex mutex_;
  int free_;
  int idle_ = 0;  ///< workers
  std::deque<OnTurn> waiting_;
};

}  // namespace grove::stream
