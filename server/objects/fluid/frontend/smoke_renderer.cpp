#include "objects/fluid/frontend/smoke_renderer.h"

#include <algorithm>
#include <cassert>

namespace grove::objects::fluid {
namespace {

/// Longest time in seconds over which particles are moved on beyond their snapshot; a late tick then stands still.
constexpr double kLongestLead = 0.1;

}  // namespace

void SmokeRenderer::draw(const FluidSnapshot& snapshot, const node::View& view, raster::Image& frame) {
  if (snapshot.count() == 0 || frame.rect.empty()) return;
  const world::Camera& camera = view.camera;
  assert(camera.width == frame.width() && camera.height == frame.height());

  const auto lead = static_cast<float>(std::clamp(view.time - snapshot.time, 0.0, kLongestLead));
  project(snapshot, camera, lead, sprites_);
  shape(camera, detail_.scale, sprites_);
  const int shapedFor = detail_.scale;
  detail_ = chooseDetail(camera, sprites_, budget_, detail_);
  if (detail_.scale != shapedFor) shape(camera, detail_.scale, sprites_);
  shading_.shade(snapshot, camera, view.lights, detail_, view.time, sprites_);

  const world::Rect box = collectVisible(camera, sprites_, order_);
  if (box.empty()) return;
  sorter_.sortBackToFront(sprites_.depth, order_);
  const float farthest = sprites_.depth[order_.front()] + 1.0F;
  target_.begin(frame, box, detail_.scale, farthest);
  target_.draw(sprites_, order_);
  target_.blendInto(frame, sprites_.depth[order_.back()]);
}

}  // namespace grove::objects::fluid
