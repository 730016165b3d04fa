#pragma once

#include "node/object_type.h"
#include "objects/figure/figure_shape.h"
#include "objects/mesh/gl_mesh_renderer.h"

namespace grove::objects::figure {

/// The rendering node of all visitors. The geometry is across-user, every picture per-user.
class FigureBackend final : public node::BackendHalf {
 public:
  explicit FigureBackend(const node::BackendServices& services);

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return workers_; }
  [[nodiscard]] int concurrency() const override { return workers_.width(); }
  /// A visitor who has left meanwhile gives a null image.
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

 private:
  const world::World& world_;
  gl::Workers& workers_;
  const mesh::LitSurface figure_;
  mesh::GlMeshRenderer renderer_;
};

}  // namespace grove::objects::figure
