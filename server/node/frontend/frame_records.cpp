#include "node/frontend/frame_records.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace grove::node {

FrameRecord& FrameRecords::open(const std::shared_ptr<const FrameList>& list) {
  [[maybe_unused]] const auto [frame, isNew] = frames_.try_emplace(list->view->frame, list);
  assert(isNew && "a frame begins once");
  forget();
  return frame->second;
}

FrameRecord* FrameRecords::find(FrameNumber frame) {
  const auto found = frames_.find(frame);
  return found == frames_.end() ? nullptr : &found->second;
}

std::vector<FrameRecord*> FrameRecords::overdue(double now) {
  std::vector<FrameRecord*> overdue;
  for (auto& [number, frame] : frames_) {
    if (frame.overdue(now)) overdue.push_back(&frame);
  }
  return overdue;
}

bool FrameRecords::overtaken(const FrameRecord& frame) const {
  return newestShown_ != nullptr && frame.number() < newestShown_->number();
}

void FrameRecords::show(FrameRecord& frame) {
  if (newestShown_ != nullptr) newestShown_->release();
  frame.show();
  newestShown_ = &frame;
}

bool FrameRecords::keepStale(const FrameRecord& late, std::uint32_t slot, Payload payload) {
  if (late.state() != FrameRecord::State::kShown) return false;
  return newestShown_->takeStale(late, slot, std::move(payload));
}

void FrameRecords::forget() {
  if (frames_.size() <= kKept) return;
  const auto isOfNoUse = [&](const auto& each) { return !each.second.inTheMaking() && &each.second != newestShown_; };
  const auto oldest = std::ranges::find_if(frames_, isOfNoUse);
  if (oldest != frames_.end()) frames_.erase(oldest);
}

}  // namespace grove::node
