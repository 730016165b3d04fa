#include "stream/frame_gate.h"

#include <utility>

namespace grove::stream {

bool FrameGate::enter(std::function<void()> onTurn) {
  const std::lock_guard lock(mutex_);
  if (free_ > 0) {
    --free_;
    return true;
  }
  waiting_.push_back(std::move(onTurn));
  return false;
}

void FrameGate::leave() {
  std::function<void()> next;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) {
      ++free_;
      return;
    }
    next = std::move(waiting_.front());
    waiting_.pop_front();
  }
  next();
}

}  // namespace grove::stream
