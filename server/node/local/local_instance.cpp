#include "node/local/local_instance.h"

#include <utility>

#include "node/backend/prepare/share_of_scene.h"

namespace grove::node {
namespace {

LoadedScene ownOf(const LocalInstance::Ground& ground) {
  if (ground.others == nullptr) return ground.scene;
  return shareOf(ground.scene, restOf(ground.scene.layout, ground.others->served()));
}

FrontendEnd& endOf(const LocalInstance::Ground& ground, const std::shared_ptr<Transport>& transport) {
  if (ground.others == nullptr) return *transport;
  ground.others->add("this process", transport);
  return *ground.others;
}

}  // namespace

LocalInstance::LocalInstance(const Ground& ground, std::shared_ptr<Transport> transport, Parallelism parallelism,
                             const BackendNode::Progress& progress)
    : ground_(ground),
      models_(ground_.scene, ground_.types, ground_.machine.memory),
      transport_(std::move(transport)),
      end_(endOf(ground_, transport_)),
      own_(ownOf(ground_)),
      backend_(own_, ground_.geometry, ground_.geometry.obstacles(), ground_.types, ground_.machine, parallelism,
               progress),
      served_(backend_.accept(transport_)) {}

}  // namespace grove::node
