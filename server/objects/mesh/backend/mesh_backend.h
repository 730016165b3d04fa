#pragma once

#include <map>
#include <memory>

#include "node/backend/backend_half.h"
#include "objects/mesh/backend/mesh_model.h"
#include "raster/drawing.h"
#include "raster/simd/screen_box.h"

namespace grove::objects::mesh {

/// The rendering node of all meshes: bakes their light once for all visitors, then draws views of them.
class MeshBackend final : public node::BackendHalf {
 public:
  /// Bakes on the services' workers and waits for them; do not call it on one of them.
  MeshBackend(const node::BackendServices& services, world::TypeIndex self);
  ~MeshBackend() override;

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  /// The GL workers if GL draws any object, else the shared workers.
  [[nodiscard]] pipeline::Executor& executor() override { return executor_; }
  [[nodiscard]] int concurrency() const override { return executor_.width(); }
  /// On the executor; several of its threads may call it at once.
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

 private:
  struct Entry {
    Entry(const world::ModelledObject& object, raster::RendererKind kind);
    raster::LitSurface lit;
    raster::PointCloud points;
    world::Mat4 toWorld;
    world::Bounds bounds;  ///< in the world
    float scale;
    raster::RendererKind renderer;
  };
  void answerWith(raster::RendererKind kind, std::span<const node::Request> requests,
                  std::span<node::Payload> payloads);

  const world::Sky& sky_;
  std::map<world::ObjectId, Entry> entries_;
  std::map<raster::RendererKind, std::unique_ptr<raster::MeshRenderer>> renderers_;
  pipeline::Executor& executor_;
  pipeline::HeldMemory held_;
};

}  // namespace grove::objects::mesh
