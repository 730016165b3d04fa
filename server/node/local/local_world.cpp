#include "node/local/local_world.h"

#include <utility>

#include "node/local/local_instance.h"
#include "node/transport/reference_transport.h"

namespace grove::node {

LocalWorld::LocalWorld(LoadedScene scene, const BackendTypes& types, gl::Workers& gl, const Machine& machine,
                       Instances instances, TransportFactory makeTransport, std::unique_ptr<NodeRouter> others)
    : scene_(std::move(scene)),
      types_(types),
      gl_(gl),
      machine_(machine),
      instances_(instances),
      makeTransport_(std::move(makeTransport)),
      others_(std::move(others)),
      geometryMemory_(machine_.memory, "obstacles", "", pipeline::Work::kAcrossUser),
      baked_(machine_.memory) {}

std::unique_ptr<InstanceNodes> LocalWorld::make(Parallelism parallelism, const Progress& progress) {
  auto transport =
      makeTransport_ ? makeTransport_(machine_.workers, machine_.timeline) : std::make_unique<ReferenceTransport>();
  if (!geometry_) {
    geometry_ = std::make_unique<const world::WorldGeometry>(scene_.objects, [&progress](float share) {
      if (progress) progress("laying out the world", share);
    });
    geometryMemory_.set(geometry_->bytes());
  }
  BakedStore* const baked = instances_ == Instances::kMany ? &baked_ : nullptr;
  const BackendMachine machine{machine_.workers, gl_, machine_.timeline, machine_.memory, machine_.images, baked};
  return std::make_unique<LocalInstance>(LocalInstance::Ground{scene_, *geometry_, types_, machine, others_.get()},
                                         std::move(transport), parallelism, progress);
}

std::vector<NodeRouter::NodeLink> LocalWorld::links() const {
  return others_ ? others_->links() : std::vector<NodeRouter::NodeLink>{};
}

std::vector<NodeRouter::NodeEvents> LocalWorld::traces(std::chrono::milliseconds max) const {
  return others_ ? others_->traces(max) : std::vector<NodeRouter::NodeEvents>{};
}

WorldNodesFactory localWorld(LoadedScene scene, const BackendTypes& types, gl::Workers& gl,
                             TransportFactory makeTransport) {
  return [scene = std::move(scene), &types, &gl, makeTransport = std::move(makeTransport)](const Machine& machine,
                                                                                           Instances instances) {
    return std::make_unique<LocalWorld>(scene, types, gl, machine, instances, makeTransport);
  };
}

}  // namespace grove::node
