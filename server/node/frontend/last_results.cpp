#include "node/frontend/last_results.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace grove::node {
namespace {

/// Whoever needs the time of so many frames is answered for a while without being shown.
constexpr std::size_t kMaxIncomplete = 16;

}  // namespace

void LastResults::keep(CompleteFrame frame) {
  if (!std::ranges::all_of(frame.fulfilled, std::identity())) incomplete_.push_back(frame.list);
  if (incomplete_.size() > kMaxIncomplete) incomplete_.pop_front();
  newest_ = std::move(frame);
}

bool LastResults::keepStale(FrameNumber frame, std::uint32_t slot, Payload payload) {
  const auto of = [&](const std::shared_ptr<const FrameList>& list) { return list->view->frame == frame; };
  const auto list = std::ranges::find_if(incomplete_, of);
  if (list == incomplete_.end() || slot >= (*list)->objects.size()) return false;
  const auto place = slotOf((*list)->objects[slot], *(*list)->view);
  if (!place || newest_.fulfilled[*place] || std::holds_alternative<Failure>(payload)) return false;
  newest_.payloads[*place] = std::move(payload);
  return true;
}

std::vector<std::size_t> LastResults::fillIn(CompleteFrame& frame) const {
  std::vector<std::size_t> filled;
  for (std::size_t slot = 0; slot < frame.payloads.size(); ++slot) {
    if (frame.fulfilled[slot]) continue;
    const auto last = slotOf(frame.list->objects[slot], *frame.list->view);
    const bool has = last && !std::holds_alternative<Failure>(newest_.payloads[*last]);
    frame.payloads[slot] = has ? newest_.payloads[*last] : Payload(Failure{"no result in time"});
    filled.push_back(slot);
  }
  return filled;
}

std::optional<std::size_t> LastResults::slotOf(const VisibleObject& object, const View& view) const {
  if (!newest_.list) return std::nullopt;
  // An image of another size could reach beyond the frame.
  const world::Camera& camera = newest_.list->view->camera;
  if (camera.width != view.camera.width || camera.height != view.camera.height) return std::nullopt;
  const auto& objects = newest_.list->objects;
  const auto found = std::ranges::find(objects, object.object.id, [](const VisibleObject& o) { return o.object.id; });
  if (found == objects.end()) return std::nullopt;
  return static_cast<std::size_t>(found - objects.begin());
}

}  // namespace grove::node
