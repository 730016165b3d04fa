#include "objects/fluid/frontend/smoke_renderer.h"

#include <algorithm>
#include <cassert>

#include "objects/fluid/common/snapshot.h"

namespace grove::objects::fluid {
namespace {

/// Longest time in seconds over which particles are moved on beyond their snapshot; a late tick then stands still.
constexpr double kLongestLead = 0.1;

const FluidSnapshot* snapshotOf(const node::Payload& payload) {
  const auto* data = std::get_if<std::shared_ptr<const node::SimulationData>>(&payload);
  return data == nullptr ? nullptr : dynamic_cast<const FluidSnapshot*>(data->get());
}

}  // namespace

void SmokeRenderer::draw(const node::VisibleObject& /*object*/, const node::Payload& payload, const node::View& view,
                         raster::Image& frame) {
  const FluidSnapshot* snapshot = snapshotOf(payload);
  if (snapshot == nullptr || snapshot->count() == 0 || frame.rect.empty()) return;
  const world::Camera& camera = view.camera;
  assert(camera.width == frame.width() && camera.height == frame.height());

  const auto lead = static_cast<float>(std::clamp(view.time - snapshot->time, 0.0, kLongestLead));
  project(*snapshot, camera, lead, sprites_);
  shape(camera, detail_.scale, sprites_);
  const int shapedFor = detail_.scale;
  detail_ = chooseDetail(camera, sprites_, budget_, detail_);
  if (detail_.scale != shapedFor) shape(camera, detail_.scale, sprites_);
  shading_.shade(*snapshot, camera, view.lights, detail_, view.time, sprites_);

  const world::Rect box = collectVisible(camera, sprites_, order_);
  if (box.empty()) return;
  sorter_.sortBackToFront(sprites_.depth, order_);
  const float farthest = sprites_.depth[order_.front()] + 1.0F;
  target_.begin(frame, box, detail_.scale, farthest);
  target_.draw(sprites_, order_);
  target_.blendInto(frame, sprites_.depth[order_.back()]);
}

std::unique_ptr<node::FrontendHalf> makeSmokeRenderer() { return std::make_unique<SmokeRenderer>(); }

}  // namespace grove::objects::fluid
