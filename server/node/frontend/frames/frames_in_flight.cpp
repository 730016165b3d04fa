#include "node/frontend/frames/frames_in_flight.h"

#include <utility>

namespace grove::node {

FramesInFlight::FramesInFlight(int max, std::function<void()> ended)
    : max_(max), ended_(ended ? std::move(ended) : [] {}) {}

bool FramesInFlight::begin() {
  const std::lock_guard lock(mutex_);
  if (closed_ || count_ >= max_) return false;
  ++count_;
  return true;
}

void FramesInFlight::end() {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    --count_;
  }
  ended_();
}

bool FramesInFlight::cancel() {
  const std::lock_guard lock(mutex_);
  if (closed_) return false;
  --count_;
  return true;
}

void FramesInFlight::close() {
  int open = 0;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    open = std::exchange(count_, 0);
  }
  for (int i = 0; i < open; ++i) ended_();
}

int FramesInFlight::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

}  // namespace grove::node
