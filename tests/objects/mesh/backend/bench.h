#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/workers.h"
#include "node/object_type.h"
#include "node/registry.h"
#include "objects/mesh/backend/mesh_model.h"
#include "pipeline/worker_pool.h"

namespace grove::objects::mesh {

/// The parts that a backend half lives among, real ones.
struct Bench {
  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders, 1};
  pipeline::WorkerPool workers{2};
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;

  [[nodiscard]] node::BackendServices services(world::World& world) {
    return {world, workers, gl, timeline, memory, images, {}};
  }
};

[[nodiscard]] world::Object makeObject(world::ObjectId id, raster::Surface surface, raster::RendererKind renderer,
                                       world::Vec3 position);

/// A world of these objects alone.
[[nodiscard]] world::World::Layout layoutOf(std::vector<world::Object> objects);

[[nodiscard]] std::shared_ptr<node::FrameList> look(const world::Camera& camera,
                                                    const std::vector<world::Object>& objects);

/// Asks the half on its own executor, one batch for all requests.
[[nodiscard]] std::vector<node::Payload> ask(node::BackendHalf& half, const std::vector<node::Request>& requests);

/// A copy that has what the spans leave out, as nothing.
[[nodiscard]] std::shared_ptr<const raster::Image> withoutSpans(const raster::Image& image);

/// The same of an answer.
[[nodiscard]] std::shared_ptr<const raster::Image> imageOf(const node::Payload& payload);

}  // namespace grove::objects::mesh
