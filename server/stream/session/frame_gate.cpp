#include "stream/session/frame_gate.h"

#include <utility>

namespace grove::stream {

bool FrameGate::enter(OnTurn onTurn) {
  const std::lock_guard lock(mutex_);
  if (free_ > 0 && idle_ > 0) {
    --free_;
    return true;
  }
  waiting_.push_back(std::move(onTurn));
  return false;
}

void FrameGate::leave() {
  {
    const std::lock_guard lock(mutex_);
    ++free_;
  }
  admitOne();
}

void FrameGate::workerIs(bool idle) {
  {
    const std::lock_guard lock(mutex_);
    idle_ += idle ? 1 : -1;
  }
  if (idle) admitOne();
}

void FrameGate::admitOne() {
  OnTurn next;
  {
    const std::lock_guard lock(mutex_);
    if (free_ == 0 || idle_ == 0 || waiting_.empty()) return;
    --free_;
    next = std::move(waiting_.front());
    waiting_.pop_front();
  }
  if (!next()) leave();
}

}  // namespace grove::stream
