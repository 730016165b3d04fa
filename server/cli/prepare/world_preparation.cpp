#include "cli/prepare/world_preparation.h"

#include <chrono>
#include <utility>

#include "base/address_space.h"
#include "base/log.h"
#include "node/frontend/frontend_process.h"
#include "node/frontend/remote_world.h"
#include "node/local/local_world.h"
#include "node/messages/served_objects.h"
#include "node/transport/grpc/dial_nodes.h"
#include "objects/builtin.h"
#include "world/scenes/scene_layout.h"

namespace grove::cli {
namespace {

/// Timeout for the welcome from nodes of other processes.
constexpr std::chrono::seconds kNodePatience{10};
/// Measured: with less than 90 MB, Mesa's drivers crash.
constexpr std::size_t kForGl = std::size_t{192} << 20U;
/// Clocks, websocket, reports, and one per type of prepared object.
constexpr std::size_t kThreadsBesidesWorkers = 12;

}  // namespace

WorldPreparation::WorldPreparation(world::Scene scene, Options options,
                                   std::function<void(std::string_view, float)> report, std::stop_token stop)
    : scene_(std::move(scene)),
      options_(std::move(options)),
      report_(std::move(report)),
      stop_(std::move(stop)),
      types_(objects::builtinTypes()),
      shaders_(options_.shaderDirectory) {}

std::unique_ptr<node::WorldNodes> WorldPreparation::make(const node::Machine& machine,
                                                         const node::WorldNodes::Progress& progress) {
  world::Layout layout = world::layoutOf(scene_, types_.frontends.names());
  if (options_.nodes.empty()) return prepareLocally(machine, progress, nullptr);
  auto others = node::dialNodes(options_.nodes, node::helloOf(options_.process, layout), kNodePatience, machine.workers,
                                machine.timeline, options_.tls);
  if (!node::restOf(layout, others->served()).empty()) return prepareLocally(machine, progress, std::move(others));
  log::info("world: " + layout.name + ", " + std::to_string(layout.objects.size()) +
            " objects, all in other processes");
  return std::make_unique<node::RemoteWorld>(std::move(layout), std::move(others));
}

std::unique_ptr<node::WorldNodes> WorldPreparation::prepareLocally(const node::Machine& machine,
                                                                   const node::WorldNodes::Progress& progress,
                                                                   std::unique_ptr<node::NodeRouter> others) {
  requireAddressSpace(kForGl);
  gl_.emplace(options_.gl, shaders_);
  std::optional<Preparations> coarse = prepareFirstLook(scene_, types_.backends, report_, stop_);
  if (!coarse) throw Stopped{};
  coarse_ = std::move(*coarse);
  node::LoadedScene loaded = node::loadScene(scene_, types_.backends);
  log::info("GL: " + gl_->description() + ", " + std::to_string(gl_->width()) + " workers");
  log::info("world: " + loaded.layout.name + ", " + std::to_string(loaded.objects.size()) + " objects");
  requireAddressSpace(options_.spaceForServing + kThreadsBesidesWorkers * stackBytes());
  return std::make_unique<node::LocalWorld>(std::move(loaded), types_.backends, *gl_, machine, progress,
                                            node::TransportFactory(), std::move(others));
}

}  // namespace grove::cli
