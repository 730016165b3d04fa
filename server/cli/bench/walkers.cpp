#include "cli/bench/walkers.h"

#include <string>
#include <utility>

namespace grove::cli {

Walker::Walker(stream::Host& host, int index, const WalkerStream& stream, Steering steering)
    : index_(index),
      steering_(std::move(steering)),
      session_(host, "Walker " + std::to_string(index + 1), stream.size.width, stream.size.height,
               [seen = seen_](const stream::FrameHeader& frame) {
                 const std::lock_guard lock(seen->mutex);
                 seen->codec = frame.codec;
                 seen->latency.shown(frame.lastInput, pipeline::wallSeconds(), seen->latencies);
               },
               {stream.codec}),
      yaw_(session_.welcome().yaw) {}

void Walker::walk(double now) {
  if (!walksSince_) walksSince_ = now;
  const world::Input input = steering_(index_, yaw_, now - *walksSince_);
  const std::lock_guard lock(seen_->mutex);
  seen_->latency.sent(session_.control(input.keys, input.yaw, input.pitch), pipeline::wallSeconds());
}

void Walker::beginCounting() {
  const std::lock_guard lock(seen_->mutex);
  seen_->latencies.clear();
  framesBefore_ = frames();
}

std::vector<float> Walker::latencies() const {
  const std::lock_guard lock(seen_->mutex);
  return seen_->latencies;
}

std::uint8_t Walker::codec() const {
  const std::lock_guard lock(seen_->mutex);
  return seen_->codec;
}

Walkers makeWalkers(stream::Host& host, int count, const WalkerStream& stream, const Steering& steering) {
  Walkers walkers;
  walkers.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) walkers.push_back(std::make_unique<Walker>(host, i, stream, steering));
  return walkers;
}

}  // namespace grove::cli
