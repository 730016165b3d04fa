#include "objects/figure/frontend/figure_labels.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::figure {
namespace {

constexpr float kFigureHeight = 1.88F;  // metres
constexpr float kAboveHead = 0.16F;     // metres
constexpr float kFadeFrom = 14.0F;      // metres
constexpr float kFadeTo = 25.0F;        // metres
constexpr float kPanelShare = 0.42F;    // opacity behind the letters
constexpr int kPadding = 4;             // pixels
constexpr std::size_t kMaxMasks = 64;

std::uint32_t blended(std::uint32_t under, float white, float opacity) {
  std::uint32_t result = under & 0xFF000000U;
  for (const unsigned shift : {0U, 8U, 16U}) {
    const auto below = static_cast<float>((under >> shift) & 0xFFU);
    result |= static_cast<std::uint32_t>(std::lround(below + (white - below) * opacity)) << shift;
  }
  return result;
}

/// Above the head.
world::Vec3 placeOf(const world::Object& object) {
  const world::Transform& transform = object.transform;
  return transform.position + world::Vec3(0.0F, (kFigureHeight + kAboveHead) * transform.scale, 0.0F);
}

/// Pixels.
int letterHeight(const world::Camera& camera) { return std::max(12, camera.height / 40); }

class LabelLayer final : public node::Layer {
 public:
  LabelLayer(FigureLabels& labels, const world::Object& object, const world::Camera& camera)
      : labels_(labels), object_(object), camera_(camera) {}

  void draw(raster::Image& frame) override { labels_.draw(object_, camera_, frame); }
  /// A name may be wider than its figure.
  [[nodiscard]] world::Rect readsDepth(const world::Rect& /*frame*/) const override {
    return labels_.panelOf(object_, camera_).value_or(world::Rect{});
  }

 private:
  FigureLabels& labels_;
  const world::Object& object_;
  const world::Camera& camera_;
};

}  // namespace

const LabelMask& FigureLabels::maskOf(const std::string& name, int pixels) {
  const std::pair<std::string, int> key(name, pixels);
  const auto it = masks_.find(key);
  if (it != masks_.end()) return it->second;
  if (masks_.size() >= kMaxMasks) masks_.clear();
  return masks_.emplace(key, font_.draw(name, pixels)).first->second;
}

std::unique_ptr<node::Layer> FigureLabels::layer(const node::VisibleObject& object, const node::Payload& /*payload*/,
                                                 const node::View& view) {
  if (object.object.id == world::kFirstPlayerObject + view.viewer) return nullptr;
  return std::make_unique<LabelLayer>(*this, object.object, view.camera);
}

std::optional<world::Rect> FigureLabels::panelOf(const world::Object& object, const world::Camera& camera) {
  const world::Vec3 at = camera.project(placeOf(object));
  if (object.name.empty() || at.z < camera.nearDepth || at.z >= kFadeTo) return std::nullopt;
  const LabelMask& mask = maskOf(object.name, letterHeight(camera));
  const int left = static_cast<int>(std::lround(at.x)) - mask.width / 2 - kPadding;
  const int top = static_cast<int>(std::lround(at.y)) - mask.height - kPadding;
  return world::Rect{left, top, left + mask.width + 2 * kPadding, top + mask.height + kPadding};
}

void FigureLabels::draw(const world::Object& object, const world::Camera& camera, raster::Image& frame) {
  const std::optional<world::Rect> panel = panelOf(object, camera);
  if (!panel) return;
  const world::Vec3 at = camera.project(placeOf(object));
  const float opacity = std::min(1.0F, (kFadeTo - at.z) / (kFadeTo - kFadeFrom));
  const LabelMask& mask = maskOf(object.name, letterHeight(camera));
  const auto [left, top, right, bottom] = panel->moved(-frame.rect.left, -frame.rect.top);
  for (int y = std::max(0, top); y < std::min(frame.height(), bottom); ++y) {
    std::uint32_t* colour = frame.colourRow(y);
    const float* depth = frame.depthRow(y);
    for (int x = std::max(0, left); x < std::min(frame.width(), right); ++x) {
      if (depth[x] < at.z) continue;
      const int column = x - left - kPadding;
      const int row = y - top - kPadding / 2;
      const bool inside = column >= 0 && column < mask.width && row >= 0 && row < mask.height;
      const float letter =
          inside ? static_cast<float>(mask.coverage.data()[std::ptrdiff_t{row} * mask.width + column]) / 255.0F : 0.0F;
      colour[x] = blended(blended(colour[x], 16.0F, kPanelShare * opacity), 245.0F, letter * opacity);
    }
  }
}

}  // namespace grove::objects::figure
