#include "cli/bench/walk/frame_shelf.h"

#include <chrono>
#include <utility>

namespace grove::cli {
namespace {

constexpr auto kMaxWait = std::chrono::seconds(60);

}  // namespace

FrameShelf::FrameShelf(std::unique_ptr<stream::Encoder> encoder, pipeline::Executor& executor,
                       pipeline::Timeline& timeline)
    : Stage({.name = "Encoder",
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = 1,
             .overflow = pipeline::Overflow::kDropOldest,
             .finishes = true},
            executor, timeline),
      encoder_(std::move(encoder)) {}

std::optional<node::FinishedFrame> FrameShelf::take() {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, kMaxWait, [this] { return frame_.has_value(); });
  return std::exchange(frame_, std::nullopt);
}

void FrameShelf::process(std::span<node::FinishedFrame> items, pipeline::Run& /*run*/) {
  if (encoder_) {
    bytes_.clear();
    encoder_->encode(*items.back().picture, {.quantiser = encoder_->range().usual, .independent = true}, bytes_);
  }
  {
    const std::lock_guard lock(mutex_);
    frame_ = items.back();
  }
  arrived_.notify_all();
}

}  // namespace grove::cli
