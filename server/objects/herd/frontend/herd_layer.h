#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "node/frontend/compositing/layer.h"
#include "objects/herd/frontend/herd_painter.h"
#include "objects/herd/frontend/shadow/deer_shadow.h"

namespace grove::objects::herd {

/// The herd in one frame of one visitor: a picture of each animal in sight, and its shadow.
class HerdLayer final : public node::Layer {
 public:
  /// Animals farther from the eye are not drawn. Metres.
  static constexpr float kFarthest = 90.0F;

  /// `painter`, `sky` and `view` outlive the layer.
  HerdLayer(HerdPainter& painter, std::shared_ptr<const HerdSnapshot> herd, const world::Sky& sky,
            const node::View& view);

  [[nodiscard]] std::size_t parts() const override { return shown_.size(); }
  void makePart(std::size_t part) override;
  void lay(node::FrameBuilder& rows) override;
  void draw(raster::Image& frame) override;
  /// The nearest animal that moves.
  [[nodiscard]] std::optional<node::Mover> mover() const override;
  [[nodiscard]] world::Rect reach(const world::Rect& rect) const override;

 private:
  /// An animal whose body or shadow is in sight.
  struct Shown {
    const Animal* animal;
    AnimalPose pose;
    float distance;
    world::Bounds bounds;
    world::Rect rect;  ///< of the body; empty if only its shadow is in sight
    std::optional<DeerShadow> shadow;
    std::shared_ptr<const raster::Image> picture;
  };
  [[nodiscard]] std::optional<Shown> shown(const Animal& animal) const;

  HerdPainter& painter_;
  const std::shared_ptr<const HerdSnapshot> herd_;
  const world::Sky& sky_;
  const node::View& view_;
  std::vector<Shown> shown_;  ///< nearest first
};

}  // namespace grove::objects::herd
