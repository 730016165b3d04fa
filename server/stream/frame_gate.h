#pragma once

#include <deque>
#include <functional>
#include <mutex>

namespace grove::stream {

/// Lets so many frames of all visitors be made at once and the others wait for their turn, first come, first served.
/// On a busy machine frames are then finished one after the other: were all begun at once, each would take as long as
/// all of them, and show a camera that is as old. Any thread.
class FrameGate {
 public:
  explicit FrameGate(int places) : free_(places) {}

  /// True: the caller has a place. False: `onTurn` is called as soon as there is one, which it then has. It is called
  /// by who leaves, without a lock of the gate; each place must be given back by leave().
  [[nodiscard]] bool enter(std::function<void()> onTurn);
  void leave();

 private:
  std::mutex mutex_;
  int free_;
  std::deque<std::function<void()>> waiting_;
};

}  // namespace grove::stream
