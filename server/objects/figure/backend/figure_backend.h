#pragma once

#include "node/backend/backend_half.h"
#include "objects/figure/backend/figure_shape.h"
#include "raster/renderer_choice.h"

namespace grove::objects::figure {

/// The rendering node of all visitors. The geometry is across-user, every picture per-user.
class FigureBackend final : public node::BackendHalf {
 public:
  explicit FigureBackend(const node::BackendServices& services,
                         raster::RendererKind kind = raster::RendererKind::kAuto);

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return executor_; }
  [[nodiscard]] int concurrency() const override { return executor_.width(); }
  /// A request for the visitor's own figure returns the parts of it that they see, their boots. On the executor;
  /// several of its threads may call it at once. Returns a null image for a visitor who has left meanwhile.
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

 private:
  const world::Layout& layout_;
  const world::WorldGeometry& geometry_;
  pipeline::Executor& executor_;
  [[nodiscard]] raster::Drawing drawingOf(const node::Request& request, const world::Player& player,
                                          const world::Object& object) const;

  const std::vector<raster::LitSurface> figures_;  ///< one for each of kStatures
  const raster::LitSurface own_;
  const std::unique_ptr<raster::MeshRenderer> renderer_;
  const pipeline::HeldMemory held_;
};

}  // namespace grove::objects::figure
