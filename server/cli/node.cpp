#include "cli/node.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "cli/host_port.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/prepare/refiner.h"
#include "cli/stop_on_signal.h"
#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/backend/backend_node.h"
#include "node/backend/prepare/share_of_scene.h"
#include "node/transport/grpc/grpc_server.h"
#include "objects/builtin.h"
#include "pipeline/worker_pool.h"

namespace grove::cli {
namespace {

using namespace std::chrono_literals;

/// Long enough for runs in progress.
constexpr auto kStopWhileNodePrepares = 900ms;
constexpr auto kStopWhileNodeServes = 4000ms;

node::LoadedScene ownShare(const node::LoadedScene& scene, const std::vector<std::string>& names) {
  std::string unknown;
  const auto own = node::namedObjects(scene, names, unknown);
  if (!own) {
    throw EnvironmentError("the scene has no object and no type '" + unknown + "'", "--objects",
                           "name objects or types of the scene");
  }
  return node::shareOf(scene, *own);
}

}  // namespace

int runNode(const NodeOptions& options) {
  const auto at = parseHostPort(options.listen);
  if (!at) {
    std::fprintf(stderr, "grove: --listen wants HOST:PORT, not '%s'\n", options.listen.c_str());
    return 2;
  }
  const node::LinkTls tls = options.links.read();
  StopOnSignal stop;
  stop.endWithin(kStopWhileNodePrepares);
  world::Scene scene = openScene(options.scene);
  setViewError(scene, options.viewError);
  const gl::ShaderLibrary shaders;
  gl::Workers gl(options.gl, shaders);
  const node::ObjectTypes types = objects::builtinTypes();
  Progress progress;
  const auto report = [&](std::string_view label, float share) { progress.show(label, share); };
  std::optional<Preparations> coarse = prepareFirstLook(scene, types.backends, report, stop.token());
  if (!coarse) return 0;
  const node::LoadedScene whole = node::loadScene(scene, types.backends);
  const node::LoadedScene own = ownShare(whole, options.objects);
  const world::WorldGeometry geometry(whole.objects);
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images(memory);
  pipeline::WorkerPool workers(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
  node::BackendNode node(own, geometry, geometry.obstacles(), types.backends, {workers, gl, timeline, memory, images},
                         node::Parallelism::kAllCores, report);
  progress.finish();
  stop.endWithin(kStopWhileNodeServes);
  const node::GrpcServer server(
      addressOf(*at, at->port), [&](std::shared_ptr<node::BackendEnd> link) { return node.accept(std::move(link)); },
      workers, timeline, tls);
  std::optional<Refiner> refiner;
  if (!coarse->empty()) refiner.emplace(std::move(*coarse), [](const stream::Refining&) {});
  log::info("world: " + own.layout.name + ", " + std::to_string(own.objects.size()) + " of " +
            std::to_string(whole.objects.size()) + " objects");
  std::printf("listening on %s\n", addressOf(*at, server.port()).c_str());
  std::fflush(stdout);
  while (stop.waitFor(1000ms) != StopOnSignal::Event::kStop) continue;
  log::info("stopping");
  return 0;
}

}  // namespace grove::cli
