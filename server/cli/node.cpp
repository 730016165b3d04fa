#include "cli/node.h"

#include <chrono>
#include <cstdio>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "cli/options/host_port.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/prepare/refiner.h"
#include "cli/stop_on_signal.h"
#include "gl/shader_library.h"
#include "gl/workers.h"
#include "measure/memory_use.h"
#include "node/backend/backend_node.h"
#include "node/backend/prepare/model_memory.h"
#include "node/backend/prepare/share_of_scene.h"
#include "node/transport/grpc/calls/remote_obstacles.h"
#include "node/transport/grpc/grpc_server.h"
#include "objects/builtin.h"
#include "pipeline/worker_pool.h"
#include "world/scenes/scene_layout.h"

namespace grove::cli {
namespace {

using namespace std::chrono_literals;

/// Long enough for runs in progress.
constexpr auto kStopWhileNodePrepares = 900ms;
constexpr auto kStopWhileNodeServes = 4000ms;

/// Timeout for the response of the node with the obstacles.
constexpr auto kObstaclePatience = 10s;

node::ServedObjects ownObjects(const world::Layout& layout, const std::vector<std::string>& names) {
  std::string unknown;
  const auto own = node::namedObjects(layout, names, unknown);
  if (!own) {
    throw EnvironmentError("the scene has no object and no type '" + unknown + "'", "--objects",
                           "name objects or types of the scene");
  }
  return *own;
}

/// Returns the client for obstacles of the node at `address`; nothing without an address. Throws EnvironmentError if an
/// own object needs all models, or if that node does not respond.
std::optional<node::RemoteObstacles> obstaclesAt(const std::optional<std::string>& address, const world::Layout& layout,
                                                 const node::ServedObjects& own, const node::BackendTypes& types,
                                                 const node::LinkTls& tls) {
  if (!address) return std::nullopt;
  if (const node::BackendType* const type = node::typeThatNeedsAllModels(layout, own, types)) {
    throw EnvironmentError("objects of the type '" + std::string(type->name()) + "' need the models of all others",
                           "--obstacles", "start a node with such objects without it");
  }
  std::optional<node::RemoteObstacles> obstacles(std::in_place, *address, layout.hash, tls);
  obstacles->waitForNode(kObstaclePatience);
  return obstacles;
}

/// Returns the address to listen at; nothing, with a line on stderr, if an option is not an address.
std::optional<stream::HostPort> addressesOf(const NodeOptions& options) {
  auto at = parseHostPort(options.listen, "--listen");
  if (!options.obstacles || parseHostPort(*options.obstacles, "--obstacles")) return at;
  return std::nullopt;
}

void reportUntilStopped(node::BackendNode& node, node::ModelMemory& models, StopOnSignal& stop) {
  while (stop.waitFor(1000ms) != StopOnSignal::Event::kStop) {
    models.update();
    node.report(measure::residentBytes());
  }
  log::info("stopping");
}

}  // namespace

int runNode(const NodeOptions& options) {
  const auto at = addressesOf(options);
  if (!at) return 2;
  const node::LinkTls tls = options.links.read();
  const node::LinkTls obstacleTls = options.obstacleLinks.read();
  StopOnSignal stop;
  stop.endWithin(kStopWhileNodePrepares);
  world::Scene scene = openScene(options.scene);
  setViewError(scene, options.viewError);
  const node::ObjectTypes types = objects::builtinTypes();
  const world::Layout layout = world::layoutOf(scene, types.backends.names());
  const node::ServedObjects owned = ownObjects(layout, options.objects);
  const auto remote = obstaclesAt(options.obstacles, layout, owned, types.backends, obstacleTls);
  const gl::ShaderLibrary shaders;
  gl::Workers gl(options.gl, shaders);
  Progress progress;
  const auto report = [&](std::string_view label, float share) { progress.show(label, share); };
  const world::Scene shown = remote ? node::shareOf(scene, owned) : scene;
  std::optional<Preparations> coarse = prepareFirstLook(shown, types.backends, report, stop.token());
  if (!coarse) return 0;
  const node::LoadedScene loaded =
      remote ? node::loadScene(scene, types.backends, owned) : node::loadScene(scene, types.backends);
  const node::LoadedScene own = node::shareOf(loaded, owned);
  const world::WorldGeometry geometry(loaded.objects);
  const world::VoxelObstacles& obstacles = remote ? *remote : geometry.obstacles();
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  const pipeline::HeldMemory geometryMemory(memory, "obstacles", "", pipeline::Work::kAcrossUser, geometry.bytes());
  node::ModelMemory models(loaded, types.backends, memory);
  raster::ImagePool images(memory);
  pipeline::WorkerPool workers(pipeline::coreCount());
  node::BackendNode node(own, geometry, obstacles, types.backends, {workers, gl, timeline, memory, images}, report);
  progress.finish();
  stop.endWithin(kStopWhileNodeServes);
  const auto answers =
      remote ? nullptr : std::make_shared<node::ObstacleAnswers>(obstacles, layout.hash, workers, timeline);
  const node::GrpcServer server(
      addressOf(*at, at->port), [&](std::shared_ptr<node::BackendEnd> link) { return node.accept(std::move(link)); },
      workers, timeline, tls, answers);
  std::optional<Refiner> refiner;
  if (!coarse->empty()) refiner.emplace(std::move(*coarse), [](const stream::Refining&) {});
  log::info("world: " + layout.name + ", " + std::to_string(own.objects.size()) + " of " +
            std::to_string(layout.objects.size()) + " objects");
  std::printf("listening on %s\n", addressOf(*at, server.port()).c_str());
  std::fflush(stdout);
  reportUntilStopped(node, models, stop);
  return 0;
}

}  // namespace grove::cli
