#include "node/backend/backend_node.h"

#include <algorithm>
#include <cassert>
#include <future>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "base/version.h"
#include "gl/workers.h"
#include "pipeline/clocks.h"

namespace grove::node {

namespace {

std::uint64_t anyNumber() {
  std::random_device device;
  return std::uint64_t{device()} << 32U | device();
}

}  // namespace

/// Receives the messages of one frontend process while the node serves it.
class BackendNode::Reception final : public BackendPort {
 public:
  Reception(BackendNode& node, std::shared_ptr<BackendEnd> link)
      : node_(node), peer_(std::make_shared<Peer>(std::move(link))) {
    peer_->subscriptions().connect([&node, weak = std::weak_ptr(peer_)](const SharedKey& what, Version known) {
      auto peer = weak.lock();
      return peer && node.push(std::move(peer), what, known);
    });
    peer_->link().connect(*this);
  }
  ~Reception() override {
    peer_->link().leaveBackend();
    node_.dismiss(*peer_);
  }
  Reception(const Reception&) = delete;
  Reception& operator=(const Reception&) = delete;

  pipeline::PushResult receive(ToBackend message) override { return node_.receive(peer_, std::move(message)); }

 private:
  BackendNode& node_;
  const std::shared_ptr<Peer> peer_;
};

BackendNode::BackendNode(const LoadedScene& scene, const world::WorldGeometry& geometry,
                         const world::VoxelObstacles& obstacles, const BackendTypes& types,
                         const BackendMachine& machine, const Progress& progress)
    : scene_(scene), geometry_(geometry), obstacles_(obstacles), machine_(machine), epoch_(anyNumber()) {
  const BackendServices services = this->services(progress);
  std::set<world::TypeIndex> used;
  for (const world::ModelledObject& object : scene.objects) used.insert(object.type);
  if (scene.visitor) used.insert(scene.layout.visitor->object.type);
  std::vector<std::pair<world::TypeIndex, std::future<std::unique_ptr<BackendPipeline>>>> prepared;
  prepared.reserve(used.size());
  for (const world::TypeIndex type : used) {
    prepared.emplace_back(type, std::async(std::launch::async, [&, type] {
                            return std::make_unique<BackendPipeline>(*types.find(scene.layout.types[type]), type,
                                                                     services);
                          }));
  }
  for (auto& [type, pipeline] : prepared) pipelines_.emplace(type, pipeline.get());
  for (const world::ModelledObject& object : scene.objects) owners_[object.id] = pipelines_.at(object.type).get();
  if (scene.visitor) visitors_ = pipelines_.at(scene.layout.visitor->object.type).get();
}

BackendNode::~BackendNode() {
  assert(peers_.empty() && "peers leave before the node is destroyed");
  peers_.awaitAnnouncements();  // by clocks of the halves: later ones reach nobody
  for (const auto& [type, pipeline] : pipelines_) pipeline->close();
  // Runs in progress use the halves. The queues are closed, so no further run starts.
  machine_.workers.drain();
  machine_.gl.drain();
  machine_.workers.drain();
}

BackendServices BackendNode::services(const Progress& progress) {
  return {.scene = scene_,
          .geometry = geometry_,
          .obstacles = obstacles_,
          .world = world_,
          .workers = machine_.workers,
          .gl = machine_.gl,
          .timeline = machine_.timeline,
          .memory = machine_.memory,
          .images = machine_.images,
          .announce = [this](const Announcement& announcement) { peers_.announce(announcement); },
          .progress = progress};
}

std::shared_ptr<void> BackendNode::accept(std::shared_ptr<BackendEnd> link) {
  return std::make_shared<Reception>(*this, std::move(link));
}

pipeline::PushResult BackendNode::receive(const std::shared_ptr<Peer>& peer, ToBackend message) {
  if (const auto* hello = std::get_if<NodeHello>(&message)) {
    greet(peer, *hello);
    return pipeline::PushResult::kAccepted;
  }
  if (const auto objection = peer->objectionTo(message)) {
    machine_.timeline.count("refused messages");
    peer->logRefusal(*objection);
    return pipeline::PushResult::kClosed;
  }
  if (auto* request = std::get_if<Request>(&message)) return take({std::move(*request), peer});
  if (auto* update = std::get_if<std::shared_ptr<const WorldUpdate>>(&message)) return apply(*peer, std::move(*update));
  if (const auto* view = std::get_if<std::shared_ptr<const View>>(&message)) {
    peer->begin(**view);
  } else if (const auto* cancel = std::get_if<Cancel>(&message)) {
    peer->end(*cancel);
  } else if (const auto* quality = std::get_if<Quality>(&message)) {
    peer->setQuality(quality->step);
    adjustQuality();
  } else if (const auto* forgotten = std::get_if<Forget>(&message)) {
    forget(*peer, forgotten->session);
  } else if (const auto* acknowledgement = std::get_if<Acknowledgement>(&message)) {
    peer->subscriptions().acknowledged(acknowledgement->what, acknowledgement->version);
  } else if (const auto* unsubscribe = std::get_if<Unsubscribe>(&message)) {
    peer->subscriptions().end(unsubscribe->what);
  } else if (const auto* trace = std::get_if<TraceRequest>(&message)) {
    sendTrace(*peer, *trace);
  }
  return pipeline::PushResult::kAccepted;
}

void BackendNode::greet(const std::shared_ptr<Peer>& peer, const NodeHello& hello) {
  dismiss(*peer);
  std::optional<std::string> objection = objectionTo(hello);
  if (!objection && !peers_.add(peer, hello.process)) {
    objection = "another frontend process has the number " + std::to_string(hello.process);
  }
  if (objection) {
    peer->link().send(ToFrontend(NodeRefusal{*objection}));
  } else {
    peer->link().send(ToFrontend(welcome()));
  }
}

void BackendNode::dismiss(Peer& peer) {
  const std::optional<ProcessId> process = peer.process();
  if (!process) return;
  world_.leave(*process);
  peers_.remove(peer);
  // A link may end before it has reported the end of each session.
  for (const SessionId session : peer.sessions()) forget(peer, session);
  peer.setQuality(0);
  adjustQuality();
}

pipeline::PushResult BackendNode::apply(Peer& peer, std::shared_ptr<const WorldUpdate> update) {
  peer.addClockReport(update->sent);
  const std::optional<ProcessId> process = peer.process();
  if (process && world_.apply(*process, std::move(update))) return pipeline::PushResult::kAccepted;
  machine_.timeline.count("world updates from a process that does not own it");
  peer.reportForeignWorld();
  return pipeline::PushResult::kClosed;
}

void BackendNode::forget(Peer& peer, SessionId session) {
  peer.forget(session);
  for (const auto& [type, pipeline] : pipelines_) pipeline->half().forget(session);
}

void BackendNode::report(std::uint64_t residentBytes) const {
  peers_.send(NodeReport{.sent = pipeline::wallSeconds(),
                         .residentBytes = residentBytes,
                         .stages = machine_.timeline.totals(),
                         .memory = machine_.memory.totals()});
}

void BackendNode::sendTrace(Peer& peer, const TraceRequest& request) const {
  if (!peer.takeTrace(pipeline::wallSeconds())) return;
  peer.link().send(std::make_shared<const NodeTrace>(traceOf(machine_.timeline, request.number)));
}

void BackendNode::adjustQuality() {
  // Held while halves announce changes. No deadlock, because announcements do not change the quality.
  const std::lock_guard lock(qualityMutex_);
  const std::optional<int> wanted = peers_.quality();
  if (!wanted || std::exchange(quality_, *wanted) == *wanted) return;
  for (const auto& [type, pipeline] : pipelines_) pipeline->half().setQuality(*wanted);
}

std::optional<std::string> BackendNode::objectionTo(const NodeHello& hello) const {
  if (hello.protocol != kProtocol) {
    return "the protocols differ: the frontend process has " + std::to_string(hello.protocol) + ", this node " +
           std::to_string(kProtocol);
  }
  if (hello.sceneHash != scene_.layout.hash) return "the scenes differ";
  for (const TypeName& type : hello.types) {
    if (type.id >= scene_.layout.types.size() || scene_.layout.types[type.id] != type.name) {
      return "this node has no objects of the type " + type.name;
    }
  }
  return std::nullopt;
}

NodeWelcome BackendNode::welcome() const {
  NodeWelcome welcome{.build = std::string(version()), .sceneHash = scene_.layout.hash, .epoch = epoch_, .objects = {}};
  welcome.objects.reserve(scene_.objects.size());
  for (const world::ModelledObject& object : scene_.objects) {
    welcome.objects.push_back({object.id, object.type, object.name, object.bounds, object.obstacleRadius});
  }
  if (visitors_ != nullptr) {
    const world::VisitorTemplate& visitor = *scene_.layout.visitor;
    welcome.visitors = {visitor.bounds, visitor.hasOwnBody, visitor.castsShadow};
  }
  return welcome;
}

pipeline::PushResult BackendNode::take(PeerRequest asked) {
  Request& request = asked.request;
  // Only receivers that unpack data use differences.
  if (asked.peer->link().sharesMemory()) request.known = 0;
  const auto owner = owners_.find(request.object);
  BackendPipeline* const pipeline = owner != owners_.end()                        ? owner->second
                                    : request.object >= world::kFirstPlayerObject ? visitors_
                                                                                  : nullptr;
  if (pipeline == nullptr) return pipeline::PushResult::kClosed;
  if (!request.subscribe) return pipeline->push(std::move(asked));
  const std::shared_ptr<Peer> peer = asked.peer;
  const SharedKey what{request.object, request.key};
  if (peer->subscriptions().begin(what)) asked.subscribed = Subscribed::kBegins;
  const pipeline::PushResult result = pipeline->push(std::move(asked));
  if (result != pipeline::PushResult::kAccepted) peer->subscriptions().end(what);
  return result;
}

bool BackendNode::push(std::shared_ptr<Peer> peer, const SharedKey& what, Version known) {
  Request request;
  request.process = peer->process().value_or(0);
  request.object = what.object;
  request.shared = true;
  request.key = what.key;
  request.known = known;
  return take({std::move(request), std::move(peer), Subscribed::kPushed}) == pipeline::PushResult::kAccepted;
}

}  // namespace grove::node
