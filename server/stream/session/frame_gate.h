#pragma once

#include <deque>
#include <functional>
#include <mutex>

namespace grove::stream {

/// Lets a frame begin when a worker has nothing to do, and the others wait for their turn, first come, first served. On
/// a busy machine frames are then finished one after the other: were all begun at once, each would take as long as all
/// of them, and show a camera that is as old. Any thread.
class FrameGate {
 public:
  /// `places`: frames that are made at once at most.
  explicit FrameGate(int places) : free_(places) {}

  /// Returns whether it takes the place.
  using OnTurn = std::function<bool()>;

  /// True: the caller has a place. False: `onTurn` is called as soon as there is one. It is called by who leaves or has
  /// become idle, without a lock of the gate; each place that is taken must be given back by leave().
  [[nodiscard]] bool enter(OnTurn onTurn);
  void leave();

  /// A worker has nothing to do, or something again.
  void workerIs(bool idle);

 private:
  void admitOne();

  std::mutex mutex_;
  int free_;
  int idle_ = 0;  ///< workers
  std::deque<OnTurn> waiting_;
};

}  // namespace grove::stream
