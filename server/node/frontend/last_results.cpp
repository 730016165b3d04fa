#include "node/frontend/last_results.h"

#include <algorithm>

namespace grove::node {

std::vector<std::size_t> LastResults::fillIn(CompleteFrame& frame) const {
  std::vector<std::size_t> filled;
  for (std::size_t slot = 0; slot < frame.payloads.size(); ++slot) {
    if (frame.fulfilled[slot]) continue;
    const Payload* last = of(frame.list->objects[slot], *frame.list->view);
    frame.payloads[slot] = last != nullptr ? *last : Payload(Failure{"no result in time"});
    filled.push_back(slot);
  }
  return filled;
}

const Payload* LastResults::of(const VisibleObject& object, const View& view) const {
  if (!newest_.list) return nullptr;
  // An image of another size could reach beyond the frame.
  const world::Camera& camera = newest_.list->view->camera;
  if (camera.width != view.camera.width || camera.height != view.camera.height) return nullptr;
  const auto& objects = newest_.list->objects;
  const auto found = std::ranges::find(objects, object.object.id, [](const VisibleObject& o) { return o.object.id; });
  if (found == objects.end()) return nullptr;
  const Payload& payload = newest_.payloads[static_cast<std::size_t>(found - objects.begin())];
  return std::holds_alternative<Failure>(payload) ? nullptr : &payload;
}

}  // namespace grove::node
