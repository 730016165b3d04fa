#include "node/backend/backend_node.h"

#include <future>
#include <set>
#include <utility>
#include <vector>

#include "base/version.h"
#include "gl/workers.h"

namespace grove::node {

BackendNode::BackendNode(const LoadedScene& scene, const world::WorldGeometry& geometry, const BackendTypes& types,
                         const BackendMachine& machine, BackendEnd& transport, Haste haste, const Progress& progress)
    : scene_(scene), geometry_(geometry), machine_(machine), transport_(transport) {
  const BackendServices services = this->services(haste, progress);
  std::set<world::TypeIndex> used;
  for (const world::ModelledObject& object : scene.objects) used.insert(object.type);
  if (scene.layout.visitor) used.insert(scene.layout.visitor->object.type);
  const auto policy = haste == Haste::kAllCores ? std::launch::async : std::launch::deferred;
  std::vector<std::pair<world::TypeIndex, std::future<std::unique_ptr<BackendPipeline>>>> prepared;
  prepared.reserve(used.size());
  for (const world::TypeIndex type : used) {
    prepared.emplace_back(type, std::async(policy, [&, type] {
                            return std::make_unique<BackendPipeline>(*types.find(scene.layout.types[type]), type,
                                                                     services, ended_, transport_);
                          }));
  }
  for (auto& [type, pipeline] : prepared) pipelines_.emplace(type, pipeline.get());
  for (const world::ModelledObject& object : scene.objects) owners_[object.id] = pipelines_.at(object.type).get();
  if (scene.layout.visitor) visitors_ = pipelines_.at(scene.layout.visitor->object.type).get();
  transport_.connect(static_cast<BackendPort&>(*this));
}

BackendNode::~BackendNode() {
  transport_.leaveBackend();
  for (const auto& [type, pipeline] : pipelines_) pipeline->close();
  // Runs in progress use the halves; with every queue closed, none can start after these.
  machine_.workers.drain();
  machine_.gl.drain();
  machine_.workers.drain();
}

BackendServices BackendNode::services(Haste haste, const Progress& progress) {
  return {.scene = scene_,
          .geometry = geometry_,
          .world = world_,
          .workers = machine_.workers,
          .gl = machine_.gl,
          .timeline = machine_.timeline,
          .memory = machine_.memory,
          .images = machine_.images,
          .announce = [this](const Announcement& announcement) { transport_.send(announcement); },
          .progress = progress,
          .helpers = haste == Haste::kAllCores ? &machine_.workers : nullptr,
          .baked = machine_.baked};
}

pipeline::PushResult BackendNode::receive(ToBackend message) {
  if (auto* request = std::get_if<Request>(&message)) return take(std::move(*request));
  if (auto* update = std::get_if<std::shared_ptr<const WorldUpdate>>(&message)) {
    world_.apply(std::move(*update));
  } else if (const auto* hello = std::get_if<NodeHello>(&message)) {
    greet(*hello);
  } else if (const auto* cancel = std::get_if<Cancel>(&message)) {
    ended_.add(*cancel);
  } else if (const auto* quality = std::get_if<Quality>(&message)) {
    for (const auto& [type, pipeline] : pipelines_) pipeline->half().setQuality(quality->step);
  } else if (const auto* forget = std::get_if<Forget>(&message)) {
    ended_.forget(forget->session);
    for (const auto& [type, pipeline] : pipelines_) pipeline->half().forget(forget->session);
  }
  return pipeline::PushResult::kAccepted;
}

void BackendNode::greet(const NodeHello& hello) {
  const std::optional<std::string> objection = objectionTo(hello);
  welcomed_ = !objection;
  if (objection) {
    transport_.send(NodeRefusal{*objection});
  } else {
    transport_.send(welcome());
  }
}

std::optional<std::string> BackendNode::objectionTo(const NodeHello& hello) const {
  if (hello.protocol != kProtocol) {
    return "it speaks protocol " + std::to_string(hello.protocol) + ", this node " + std::to_string(kProtocol);
  }
  if (hello.sceneHash != scene_.layout.hash) return "it shows another scene";
  for (const TypeName& type : hello.types) {
    if (type.id >= scene_.layout.types.size() || scene_.layout.types[type.id] != type.name) {
      return "this node has no objects of the type " + type.name;
    }
  }
  return std::nullopt;
}

NodeWelcome BackendNode::welcome() const {
  NodeWelcome welcome{.build = std::string(version()), .sceneHash = scene_.layout.hash, .objects = {}};
  welcome.objects.reserve(scene_.objects.size());
  for (const world::ModelledObject& object : scene_.objects) {
    welcome.objects.push_back({object.id, object.type, object.name, object.bounds});
  }
  return welcome;
}

pipeline::PushResult BackendNode::take(Request request) {
  if (!welcomed_) return pipeline::PushResult::kClosed;
  // Differences are for who unpacks them.
  if (transport_.sharesMemory()) request.known = 0;
  const auto owner = owners_.find(request.object);
  BackendPipeline* const pipeline = owner != owners_.end()                        ? owner->second
                                    : request.object >= world::kFirstPlayerObject ? visitors_
                                                                                  : nullptr;
  return pipeline == nullptr ? pipeline::PushResult::kClosed : pipeline->push(std::move(request));
}

}  // namespace grove::node
