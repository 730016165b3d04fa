#include "node/frontend/frames/frame_records.h"

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
  FrameRecord* const before = newestShown_;
  FrameRecord* const drawnBefore = newestDrawn_;
  frame.show();
  newestShown_ = &frame;
  if (frame.list()->drawsBackdrop() && !frame.list()->extended) newestDrawn_ = &frame;
  for (FrameRecord* const each : {before, drawnBefore}) {
    if (each != nullptr && each != newestShown_ && each != newestDrawn_) each->release();
  }
}

bool FrameRecords::keepStale(const FrameRecord& late, std::uint32_t slot, Payload payload) {
  if (late.state() != FrameRecord::State::kShown) return false;
  if (late.object(slot).still && newestDrawn_ != nullptr) {
    return newestDrawn_->takeStale(late, slot, std::move(payload));
  }
  return newestShown_->takeStale(late, slot, std::move(payload));
}

std::vector<FrameRecord*> FrameRecords::showingBackdropOf(const FrameRecord& frame) {
  std::vector<FrameRecord*> showing;
  for (auto& [number, each] : frames_) {
    if (each.inTheMaking() && each.list()->backdrop == frame.number()) showing.push_back(&each);
  }
  return showing;
}

bool FrameRecords::waitsForBackdrop(const FrameRecord& frame) {
  const std::optional<FrameNumber> backdrop = frame.list()->backdrop;
  if (!backdrop || frame.list()->drawsBackdrop()) return false;
  const FrameRecord* const drawing = find(*backdrop);
  return drawing != nullptr && drawing->inTheMaking();
}

void FrameRecords::forget() {
  if (frames_.size() <= kKept) return;
  const auto isOfNoUse = [&](const auto& each) {
    return !each.second.inTheMaking() && &each.second != newestShown_ && &each.second != newestDrawn_;
  };
  const auto oldest = std::ranges::find_if(frames_, isOfNoUse);
  if (oldest != frames_.end()) frames_.erase(oldest);
}

}  // namespace grove::node
