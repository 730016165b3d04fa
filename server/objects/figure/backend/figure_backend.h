#pragma once

#include <optional>

#include "node/backend/backend_half.h"
#include "objects/figure/backend/figure_shape.h"
#include "objects/figure/backend/shadow/ground_sun.h"
#include "objects/figure/backend/shadow/shadow_masks.h"
#include "objects/figure/backend/shadow/sun_shadow.h"
#include "raster/renderer_choice.h"

namespace grove::objects::figure {

/// The rendering node of all visitors. The geometry and the shapes of shadows are across-user, every picture per-user.
class FigureBackend final : public node::BackendHalf {
 public:
  explicit FigureBackend(const node::BackendServices& services,
                         raster::RendererKind kind = raster::RendererKind::kAuto);

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return executor_; }
  [[nodiscard]] int concurrency() const override { return executor_.width(); }
  /// A request for the visitor's own figure returns what they see of it, their boots and shadows. On the executor;
  /// several of its threads may call it at once. Returns a null image for a visitor who has left meanwhile, and where
  /// nothing of the figure is in the picture.
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

 private:
  const world::Layout& layout_;
  const world::WorldGeometry& geometry_;
  pipeline::Executor& workers_;
  pipeline::Executor& executor_;

  struct Figure {
    raster::Drawing drawing;
    world::Vec3 place;
    std::optional<SunShadow> shadow;
  };
  [[nodiscard]] std::optional<Figure> figureOf(const node::Request& request);
  [[nodiscard]] std::optional<SunShadow> shadowOf(const world::Player& player, world::Vec3 place,
                                                  const world::Camera& camera);

  const std::vector<raster::LitSurface> figures_;  ///< one for each of kStatures
  const raster::LitSurface own_;
  ShadowMasks masks_;
  const GroundSun sun_;
  const std::unique_ptr<raster::MeshRenderer> renderer_;
  const pipeline::HeldMemory held_;
};

}  // namespace grove::objects::figure
