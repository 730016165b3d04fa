#include "stream/session/world_instance.h"

#include <algorithm>
#include <set>
#include <utility>

#include "node/backend/prepare/share_of_scene.h"
#include "pipeline/clocks.h"

namespace grove::stream {
namespace {

constexpr double kUpdateSeconds = 1.0 / 30.0;

node::LoadedScene ownOf(const WorldGround& ground) {
  if (ground.others == nullptr) return ground.scene;
  return node::shareOf(ground.scene, node::restOf(ground.scene.layout, ground.others->served()));
}

node::FrontendEnd& nodesOf(const WorldGround& ground, const std::shared_ptr<node::Transport>& transport) {
  if (ground.others == nullptr) return *transport;
  ground.others->add("this process", transport);
  return *ground.others;
}

}  // namespace

WorldInstance::WorldInstance(const WorldGround& ground, std::unique_ptr<node::Transport> transport,
                             node::Parallelism parallelism, const node::BackendNode::Progress& progress)
    : ground_(ground),
      world_(ground.scene.layout, ground.players),
      transport_(std::move(transport)),
      nodes_(nodesOf(ground, transport_)),
      own_(ownOf(ground)),
      backend_(own_, *ground_.geometry, ground.types.backends, ground.machine, parallelism, progress),
      served_(backend_.accept(transport_)),
      frontend_(ground.process, world_.layout(), ground.types.frontends, nodes_,
                {ground.machine.workers, ground.machine.timeline, ground.machine.memory, ground.machine.images,
                 world_.layout().sky},
                ground.maxSharedBytes),
      joined_(ground_.owner ? std::make_unique<node::JoinedWorld>(ground_.process, world_, *ground_.owner,
                                                                  [this] { tellBackend(); })
                            : nullptr) {
  if (joined_) joined_->join();
  reportModels();
}

WorldInstance::~WorldInstance() = default;

void WorldInstance::publish() {
  const double now = pipeline::wallSeconds();
  nextUpdate_ = std::max(nextUpdate_ + kUpdateSeconds, now + kUpdateSeconds / 2);
  if (joined_) joined_->report(now);
  // Else the owner's answer is passed on. Without an owner the world goes on by itself.
  if (!joined_ || joined_->status(now).state != node::JoinedWorld::State::kJoined) tellBackend();
}

void WorldInstance::tellBackend() {
  const std::lock_guard lock(updateMutex_);
  auto update = std::make_shared<node::WorldUpdate>();
  update->number = ++updates_;
  update->sent = pipeline::wallSeconds();
  update->clock = worldSeconds(update->sent);
  update->players = world_.players().all(update->sent);
  world::Edits::Cursor edits = edits_;
  update->gusts = world_.edits().during(edits, update->players);
  const auto sent = frontend_.send(std::shared_ptr<const node::WorldUpdate>(std::move(update)));
  // What blew goes with the next one, if this one was not taken.
  if (sent == pipeline::PushResult::kAccepted) edits_ = edits;
}

double WorldInstance::publishIfDue(double now) {
  if (now >= nextUpdate_) publish();
  return nextUpdate_;
}

double WorldInstance::worldSeconds(double now) const { return joined_ ? joined_->worldSeconds(now) : now; }

std::optional<node::JoinedWorld::Status> WorldInstance::joined(double now) const {
  return joined_ ? std::optional(joined_->status(now)) : std::nullopt;
}

void WorldInstance::reportModels() {
  std::map<world::TypeIndex, std::set<const world::Model*>> models;
  for (const world::ModelledObject& object : ground_.scene.objects) models[object.type].insert(object.model.get());
  for (const auto& [type, distinct] : models) {
    std::size_t bytes = 0;
    for (const world::Model* model : distinct) bytes += model->bytes();
    models_
        .try_emplace(type, ground_.machine.memory, "models", ground_.scene.layout.types[type],
                     pipeline::Work::kAcrossUser)
        .first->second.set(bytes);
  }
}

void WorldInstance::setQuality(int step) { frontend_.send(node::Quality{step}); }

void WorldInstance::forget(node::SessionId session) { frontend_.send(node::Forget{session}); }

}  // namespace grove::stream
