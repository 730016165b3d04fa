#include "node/frontend/frontend_process.h"

#include <algorithm>
#include <cassert>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "base/log.h"
#include "base/version.h"
#include "node/messages/packing/picture_packing.h"
#include "node/messages/served_objects.h"

namespace grove::node {

NodeHello helloOf(ProcessId process, const world::Layout& layout) {
  NodeHello hello{.build = std::string(version()), .sceneHash = layout.hash, .process = process, .types = {}};
  hello.types.reserve(layout.types.size());
  for (world::TypeIndex type = 0; type < layout.types.size(); ++type) hello.types.push_back({type, layout.types[type]});
  return hello;
}

FrontendProcess::FrontendProcess(ProcessId id, const world::Layout& layout, const FrontendTypes& types,
                                 FrontendEnd& transport, const FrontendTools& tools, std::size_t maxSharedBytes)
    : id_(id),
      layout_(layout),
      types_(types),
      transport_(transport),
      tools_(tools),
      redrawTurns_(tools.workers.width()),
      store_(maxSharedBytes,
             [this](ToBackend message) {
               if (auto* const request = std::get_if<Request>(&message)) request->process = id_;
               return send(std::move(message)) == pipeline::PushResult::kAccepted;
             }),
      sharedReceiver_(std::make_shared<SharedReceiver>(*this, tools.workers, tools.timeline)) {
  transport_.connect(static_cast<FrontendPort&>(*this));
  transport_.send(helloOf(id, layout));
}

FrontendProcess::~FrontendProcess() {
  transport_.leaveFrontend();
  sharedReceiver_->close();
  tools_.workers.drain();
}

void FrontendProcess::connect(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver) {
  pictures_.begin(session);
  const std::unique_lock lock(mutex_);
  sessions_[session] = std::move(receiver);
}

void FrontendProcess::disconnect(SessionId session) {
  const std::unique_lock lock(mutex_);
  sessions_.erase(session);
  pictures_.end(session);
}

pipeline::PushResult FrontendProcess::requestPicture(Request request) {
  pictures_.add(request);
  return send(std::move(request));
}

void FrontendProcess::receive(ToFrontend message) {
  if (const auto* announcement = std::get_if<Announcement>(&message)) {
    store_.announced(*announcement);
  } else if (const auto* welcome = std::get_if<NodeWelcome>(&message)) {
    welcomed(*welcome);
  } else if (const auto* refusal = std::get_if<NodeRefusal>(&message)) {
    log::error("a backend node refuses this frontend process: " + refusal->reason);
  } else if (auto* result = std::get_if<Result>(&message)) {
    receive(std::move(*result));
  }
}

void FrontendProcess::welcomed(const NodeWelcome& welcome) {
  const ServedObjects served = servedBy(welcome);
  std::set<world::ObjectId> named = served.objects;
  // All objects that show visitors count as one.
  if (served.visitors) named.insert(world::kFirstPlayerObject);
  bool isKnown = false;
  bool isRestarted = false;
  {
    const std::unique_lock lock(mutex_);
    for (const world::ObjectId id : named) {
      const auto [last, isNew] = epochs_.try_emplace(id, welcome.epoch);
      isKnown = isKnown || !isNew;
      isRestarted = std::exchange(last->second, welcome.epoch) != welcome.epoch || isRestarted;
    }
  }
  if (!isKnown) return;
  if (sharedReceiver_->push(Renewal{served, isRestarted}) == pipeline::PushResult::kAccepted) return;
  // A renewal must not be lost.
  store_.renew([&](world::ObjectId id) { return served.contains(id); }, isRestarted);
}

void FrontendProcess::receive(Result result) {
  if (result.shared) {
    const Announcement lost{result.what, result.version};
    const bool isPushed = result.pushed;
    // A lost pushed version has no request that could time out.
    if (sharedReceiver_->push(std::move(result)) != pipeline::PushResult::kAccepted && isPushed) store_.announced(lost);
    return;
  }
  std::shared_ptr<pipeline::Inlet<Result>> receiver;
  {
    const std::shared_lock lock(mutex_);
    const auto session = sessions_.find(result.session);
    if (session != sessions_.end()) receiver = session->second.lock();
  }
  if (receiver) receiver->push(std::move(result));
}

void FrontendProcess::unpack(Result& result) {
  const std::optional<world::Rect> asked = result.shared ? std::nullopt : pictures_.take(result);
  if (!result.packed) return;
  const std::shared_ptr<const PackedBytes> bytes = std::exchange(result.packed, nullptr);
  if (!result.shared) {
    if (!asked) throw PackingError("a picture was not requested");
    result.payload = unpackPicture(*bytes, *asked, tools_.images);
    return;
  }
  const FrontendType* const type = typeOf(result.what.object);
  if (type == nullptr) throw PackingError("shared data has no object");
  const std::shared_ptr<const SharedData> known = store_.known(result.what);
  const std::shared_ptr<SharedData> data = type->unpack(result.what.key, result.version, *bytes, known.get());
  // For data that came by reference, its maker reports the memory.
  const bool isOnDemand = !result.what.key.empty();
  data->holdIn(tools_.memory, isOnDemand ? "shared store, on demand" : "shared store", type->name(),
               isOnDemand ? pipeline::Work::kOnDemand : pipeline::Work::kAcrossUser);
  result.payload = std::shared_ptr<const SharedData>(data);
}

const FrontendType* FrontendProcess::typeOf(world::ObjectId id) const {
  if (id >= world::kFirstPlayerObject && layout_.visitor) return &type(layout_.visitor->object.type);
  const auto object = std::ranges::find(layout_.objects, id, &world::Object::id);
  return object == layout_.objects.end() ? nullptr : &type(object->type);
}

const FrontendType& FrontendProcess::type(world::TypeIndex index) const {
  const FrontendType* const type = types_.find(layout_.types[index]);
  assert(type != nullptr && "the process has all types of the world");
  return *type;
}

}  // namespace grove::node
