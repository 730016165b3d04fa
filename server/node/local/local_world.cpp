#include "node/local/local_world.h"

#include <utility>

#include "node/backend/prepare/share_of_scene.h"
#include "node/transport/reference_transport.h"

namespace grove::node {
namespace {

std::shared_ptr<Transport> transportOf(const TransportFactory& make, const Machine& machine) {
  if (!make) return std::make_shared<ReferenceTransport>();
  return make(machine.workers, machine.timeline);
}

LoadedScene ownOf(const LoadedScene& scene, const NodeRouter* others) {
  return others == nullptr ? scene : shareOf(scene, restOf(scene.layout, others->served()));
}

FrontendEnd& endOf(NodeRouter* others, const std::shared_ptr<Transport>& transport) {
  if (others == nullptr) return *transport;
  others->add("this process", transport);
  return *others;
}

}  // namespace

LocalWorld::LocalWorld(LoadedScene scene, const BackendTypes& types, gl::Workers& gl, const Machine& machine,
                       const Progress& progress, const TransportFactory& makeTransport,
                       std::unique_ptr<NodeRouter> others)
    : scene_(std::move(scene)),
      others_(std::move(others)),
      geometry_(scene_.objects,
                [&progress](float share) {
                  if (progress) progress("laying out the world", share);
                }),
      geometryMemory_(machine.memory, "obstacles", "", pipeline::Work::kAcrossUser, geometry_.bytes()),
      models_(scene_, types, machine.memory),
      transport_(transportOf(makeTransport, machine)),
      end_(endOf(others_.get(), transport_)),
      own_(ownOf(scene_, others_.get())),
      backend_(own_, geometry_, geometry_.obstacles(), types,
               {machine.workers, gl, machine.timeline, machine.memory, machine.images}, progress),
      served_(backend_.accept(transport_)) {}

std::vector<NodeRouter::NodeLink> LocalWorld::links() const {
  return others_ ? others_->links() : std::vector<NodeRouter::NodeLink>{};
}

std::vector<NodeRouter::NodeEvents> LocalWorld::traces(std::chrono::milliseconds max) const {
  return others_ ? others_->traces(max) : std::vector<NodeRouter::NodeEvents>{};
}

WorldNodesFactory localWorld(LoadedScene scene, const BackendTypes& types, gl::Workers& gl,
                             TransportFactory makeTransport) {
  return [scene = std::move(scene), &types, &gl, makeTransport = std::move(makeTransport)](
             const Machine& machine, const WorldNodes::Progress& progress) {
    return std::make_unique<LocalWorld>(scene, types, gl, machine, progress, makeTransport);
  };
}

}  // namespace grove::node
