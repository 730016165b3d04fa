#pragma once

#include <utility>
#include <vector>

#include "gl/workers.h"
#include "node/backend/backend_services.h"
#include "node/messages.h"
#include "pipeline/worker_pool.h"

namespace grove::tests {

/// A world of some objects, as a backend node knows it.
struct BackendWorld {
  explicit BackendWorld(node::LoadedScene loaded) : scene(std::move(loaded)) {}
  explicit BackendWorld(std::vector<world::ModelledObject> objects = {}) : scene(sceneOf(std::move(objects))) {}

  static node::LoadedScene sceneOf(std::vector<world::ModelledObject> objects) {
    node::LoadedScene scene;
    scene.layout.objects.assign(objects.begin(), objects.end());
    scene.objects = std::move(objects);
    return scene;
  }

  [[nodiscard]] const std::vector<world::Object>& objects() const { return scene.layout.objects; }

  node::LoadedScene scene;
  world::WorldGeometry geometry{scene.objects};
  node::WorldMirror mirror;
};

/// The machine that a backend half works on.
struct BackendStand {
  explicit BackendStand(int threads = 1, pipeline::WorkerPool::Load load = pipeline::WorkerPool::kIgnored)
      : workers(threads, "test-worker", {}, load) {}

  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders, 1};
  pipeline::WorkerPool workers;
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;

  [[nodiscard]] node::BackendServices services(const BackendWorld& world) {
    return {.scene = world.scene,
            .geometry = world.geometry,
            .obstacles = world.geometry.obstacles(),
            .world = world.mirror,
            .workers = workers,
            .gl = gl,
            .timeline = timeline,
            .memory = memory,
            .images = images,
            .announce = [](const node::Announcement&) {},
            .progress = [](std::string_view, float) {}};
  }
};

/// What a frontend node asks for an object of a frame that is a picture.
[[nodiscard]] inline node::Request pictureRequest(const node::FrameList& list, std::uint32_t slot) {
  const node::VisibleObject& visible = list.objects.at(slot);
  node::Request request;
  request.view = list.view;
  request.slot = slot;
  request.object = visible.object.id;
  request.player = list.view->shownBy(visible.object.id);
  request.rect = visible.rect;
  request.distance = visible.distance;
  return request;
}

/// And for shared data.
[[nodiscard]] inline node::Request sharedRequest(world::ObjectId object, node::Key key = {}) {
  node::Request request;
  request.object = object;
  request.shared = true;
  request.key = std::move(key);
  return request;
}

}  // namespace grove::tests
