#include "objects/figure/frontend/figure_labels.h"

#include <algorithm>
#include <cmath>

#include "objects/figure/common/stature.h"
#include "objects/figure/frontend/figure_motion.h"

namespace grove::objects::figure {
namespace {

constexpr float kAboveHead = 0.08F;  // metres
constexpr float kHeadWidth = 0.3F;   // metres
constexpr float kHeadHeight = 0.4F;  // metres, with the hood
constexpr float kFadeFrom = 18.0F;   // metres
constexpr float kFadeTo = 25.0F;     // metres
/// Depths less than this in front of the figure's middle belong to the figure itself. Metres.
constexpr float kOwnDepth = 0.5F;
/// Rows and columns of the grid of tested pixels.
constexpr int kLooks = 6;

class LabelLayer final : public node::Layer {
 public:
  LabelLayer(const world::Object& object, const world::Camera& camera, const std::optional<node::Mover>& mover)
      : object_(object), camera_(camera), mover_(mover) {}

  [[nodiscard]] std::optional<node::Label> label(const raster::Image& frame) const override {
    return labelOf(object_, camera_, frame);
  }
  [[nodiscard]] std::optional<node::Mover> mover() const override { return mover_; }
  [[nodiscard]] world::Rect reach(const world::Rect& /*rect*/) const override {
    return headOf(object_, camera_).value_or(world::Rect{});
  }

 private:
  const world::Object& object_;
  const world::Camera& camera_;
  const std::optional<node::Mover> mover_;
};

/// Projects the point of a figure's axis `height` metres above its feet, as Camera::project() does.
world::Vec3 projected(const world::Object& object, const world::Camera& camera, float height) {
  return camera.project(object.transform.position + world::Vec3(0.0F, height * scaleOf(object), 0.0F));
}

/// The share of a grid of pixels in `rect` with nothing nearer than `depth`. Pixels beyond the frame count as hidden.
float seenShare(const world::Rect& rect, float depth, const raster::Image& frame) {
  int seen = 0;
  for (int row = 0; row < kLooks; ++row) {
    const int y = rect.top + (2 * row + 1) * rect.height() / (2 * kLooks) - frame.rect.top;
    for (int column = 0; column < kLooks; ++column) {
      const int x = rect.left + (2 * column + 1) * rect.width() / (2 * kLooks) - frame.rect.left;
      const bool inside = x >= 0 && y >= 0 && x < frame.width() && y < frame.height();
      if (inside && frame.depthRow(y)[x] >= depth) ++seen;
    }
  }
  return static_cast<float>(seen) / (kLooks * kLooks);
}

}  // namespace

std::unique_ptr<node::Layer> FigureLabels::layer(const node::VisibleObject& object, const node::Payload& /*payload*/,
                                                 const node::View& view) {
  if (object.object.id == world::kFirstPlayerObject + view.viewer) return nullptr;
  const std::optional<world::Player> player = view.shownBy(object.object.id);
  return std::make_unique<LabelLayer>(object.object, view.camera,
                                      player ? moverOf(object.object, *player, view.camera) : std::nullopt);
}

std::optional<world::Rect> headOf(const world::Object& object, const world::Camera& camera) {
  const world::Vec3 top = projected(object, camera, kFigureHeight);
  if (top.z < camera.nearDepth || top.z >= kFadeTo) return std::nullopt;
  const float pixels = camera.focal() * scaleOf(object) / top.z;  // per metre
  const float half = 0.5F * kHeadWidth * pixels;
  const auto whole = [](float value) { return static_cast<int>(std::lround(std::clamp(value, -1e6F, 1e6F))); };
  const world::Rect head{whole(top.x - half), whole(top.y), whole(top.x + half), whole(top.y + kHeadHeight * pixels)};
  // A distant head still covers at least one pixel.
  return world::Rect{head.left, head.top, std::max(head.right, head.left + 1), std::max(head.bottom, head.top + 1)};
}

std::optional<node::Label> labelOf(const world::Object& object, const world::Camera& camera,
                                   const raster::Image& frame) {
  const auto head = headOf(object, camera);
  if (!head || object.name.empty()) return std::nullopt;
  const world::Vec3 at = projected(object, camera, kFigureHeight + kAboveHead);
  const float near = std::min(1.0F, (kFadeTo - at.z) / (kFadeTo - kFadeFrom));
  const float opacity = near * seenShare(*head, at.z - kOwnDepth, frame);
  if (opacity <= 0.0F) return std::nullopt;
  const world::Vec2 size(static_cast<float>(camera.width), static_cast<float>(camera.height));
  return node::Label{object.id, glm::clamp(world::Vec2(at), world::Vec2(0.0F), size), at.z, opacity};
}

}  // namespace grove::objects::figure
