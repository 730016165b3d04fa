#include "objects/fluid/smoke_renderer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "objects/fluid/snapshot.h"

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
                         node::Image& frame) {
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

  const world::Rect box = collectVisible(camera);
  if (box.empty()) return;
  sorter_.sortBackToFront(sprites_.depth, order_);
  const float farthest = sprites_.depth[order_.front()] + 1.0F;
  target_.begin(frame, box, detail_.scale, farthest);
  target_.draw(sprites_, order_);
  target_.blendInto(frame, sprites_.depth[order_.back()]);
}

world::Rect SmokeRenderer::collectVisible(const world::Camera& camera) {
  order_.clear();
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  float left = width;
  float top = height;
  float right = 0.0F;
  float bottom = 0.0F;
  for (std::size_t i = 0; i < sprites_.count; ++i) {
    const float depth = sprites_.depth[i];
    if (depth < camera.nearDepth || depth > camera.farDepth) continue;
    if (sprites_.opacity[i] < kLeastOpacity) continue;
    const float x = sprites_.x[i];
    const float y = sprites_.y[i];
    const float w = sprites_.halfWidth[i];
    const float h = sprites_.halfHeight[i];
    if (x + w <= 0.0F || y + h <= 0.0F || x - w >= width || y - h >= height) continue;
    left = std::min(left, x - w);
    top = std::min(top, y - h);
    right = std::max(right, x + w);
    bottom = std::max(bottom, y + h);
    order_.push_back(static_cast<std::uint32_t>(i));
  }
  if (order_.empty()) return {};
  return {static_cast<int>(std::max(left, 0.0F)), static_cast<int>(std::max(top, 0.0F)),
          static_cast<int>(std::ceil(std::min(right, width))), static_cast<int>(std::ceil(std::min(bottom, height)))};
}

std::unique_ptr<node::FrontendHalf> makeSmokeRenderer() { return std::make_unique<SmokeRenderer>(); }

}  // namespace grove::objects::fluid
