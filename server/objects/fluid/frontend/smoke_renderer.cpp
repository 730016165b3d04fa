#include "objects/fluid/frontend/smoke_renderer.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace grove::objects::fluid {
namespace {

/// Longest extrapolation of particles beyond their snapshot, in seconds; if a tick is later than that, the smoke stands
/// still.
constexpr double kLongestLead = 0.1;

}  // namespace

world::Rect SmokeRenderer::prepare(const FluidSnapshot& snapshot, const node::View& view) {
  box_ = {};
  const world::Camera& camera = view.camera;
  if (snapshot.count() == 0 || camera.width <= 0 || camera.height <= 0) return box_;

  const auto lead = static_cast<float>(std::clamp(view.time - snapshot.time, 0.0, kLongestLead));
  camera_ = camera;
  seconds_ = std::isfinite(snapshot.time) ? snapshot.time + static_cast<double>(lead) : 0.0;
  project(snapshot, camera, lead, sprites_);
  shape(camera, detail_.scale, sprites_);
  const int shapedFor = detail_.scale;
  detail_ = chooseDetail(camera, sprites_, budget_, detail_);
  if (detail_.scale != shapedFor) shape(camera, detail_.scale, sprites_);
  shading_.shade(snapshot, camera, view.lights, detail_, view.time, sprites_);

  box_ = collectVisible(camera, sprites_, order_);
  if (box_.empty()) return box_;
  // The target's pixels are larger than the frame's and depend on their neighbours.
  const int margin = 2 * detail_.scale;
  return {box_.left - margin, box_.top - margin, box_.right + margin, box_.bottom + margin};
}

void SmokeRenderer::draw(raster::Image& frame) {
  if (box_.empty()) return;
  sorter_.sortBackToFront(sprites_.depth, order_);
  const float farthest = sprites_.depth[order_.front()] + 1.0F;
  const float nearest = sprites_.depth[order_.back()];
  // Embers shine through the smoke, and have no curls.
  const auto isSmoke = [&](std::uint32_t i) { return sprites_.ember[i] == 0.0F; };
  const auto embers = std::stable_partition(order_.begin(), order_.end(), isSmoke);
  const std::span<const std::uint32_t> all(order_);
  const auto smoke = static_cast<std::size_t>(embers - order_.begin());
  target_.begin(frame, box_, detail_.scale, farthest);
  target_.draw(sprites_, all.first(smoke));
  target_.carve(camera_, seconds_, sun_);
  target_.draw(sprites_, all.subspan(smoke));
  target_.blendInto(frame, nearest);
}

}  // namespace grove::objects::fluid
