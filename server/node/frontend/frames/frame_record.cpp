#include "node/frontend/frames/frame_record.h"

#include <algorithm>
#include <utility>

namespace grove::node {

FrameRecord::FrameRecord(std::shared_ptr<const FrameList> list)
    : list_(std::move(list)), slots_(list_->objects.size()), missing_(slots_.size()) {}

void FrameRecord::ask(std::uint32_t slot, Ask ask) {
  ++slots_[slot].rounds;
  slots_[slot].asked = std::move(ask);
}

const Ask* FrameRecord::asked(std::uint32_t slot) const {
  return slot < slots_.size() && slots_[slot].asked ? &*slots_[slot].asked : nullptr;
}

bool FrameRecord::answer(std::uint32_t slot, Payload& payload) {
  if (slot >= slots_.size()) return false;
  Slot& answered = slots_[slot];
  answered.asked.reset();
  if (!inTheMaking() || answered.answered) return false;
  answered.payload = std::move(payload);
  answered.answered = true;
  --missing_;
  return true;
}

std::vector<std::uint32_t> FrameRecord::fillIn(std::initializer_list<const FrameRecord*> earlier) {
  std::vector<std::uint32_t> filled;
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot].answered) continue;
    slots_[slot].payload = Failure{"no result in time"};
    if (const Payload* const payload = lastOf(slot, earlier)) slots_[slot].payload = *payload;
    filled.push_back(slot);
    markStale();
  }
  return filled;
}

const Payload* FrameRecord::lastOf(std::uint32_t slot, std::initializer_list<const FrameRecord*> earlier) const {
  for (const FrameRecord* const frame : earlier) {
    const Payload* const payload = frame == nullptr ? nullptr : frame->shownWith(object(slot), view());
    if (payload != nullptr) return payload;
  }
  return nullptr;
}

bool FrameRecord::takeStale(const FrameRecord& late, std::uint32_t slot, Payload payload) {
  const auto place = slotOf(late.object(slot), late.view());
  if (!place || slots_[*place].answered || std::holds_alternative<Failure>(payload)) return false;
  slots_[*place].payload = std::move(payload);
  return true;
}

CompleteFrame FrameRecord::toShow() const {
  CompleteFrame frame{list_, {}, stale_};
  frame.payloads.reserve(slots_.size());
  for (const Slot& slot : slots_) frame.payloads.push_back(slot.payload);
  return frame;
}

void FrameRecord::drop() {
  state_ = State::kDropped;
  release();
}

void FrameRecord::release() {
  for (Slot& slot : slots_) slot.payload = {};
}

const Payload* FrameRecord::shownWith(const VisibleObject& object, const View& view) const {
  const auto place = slotOf(object, view);
  return place && !std::holds_alternative<Failure>(slots_[*place].payload) ? &slots_[*place].payload : nullptr;
}

std::optional<std::size_t> FrameRecord::slotOf(const VisibleObject& object, const View& view) const {
  // An image of another size could reach beyond the frame.
  const world::Camera& camera = this->view().camera;
  if (camera.width != view.camera.width || camera.height != view.camera.height) return std::nullopt;
  const auto& objects = list_->objects;
  const auto found = std::ranges::find(objects, object.object.id, [](const VisibleObject& o) { return o.object.id; });
  if (found == objects.end()) return std::nullopt;
  return static_cast<std::size_t>(found - objects.begin());
}

}  // namespace grove::node
