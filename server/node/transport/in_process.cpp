#include "node/transport/in_process.h"

#include <mutex>
#include <utility>

namespace grove::node {

void InProcessTransport::connectBackend(world::TypeIndex type, std::shared_ptr<pipeline::Inlet<Request>> receiver) {
  const std::unique_lock lock(mutex_);
  backends_[type] = std::move(receiver);
}

void InProcessTransport::connectFrontend(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver) {
  const std::unique_lock lock(mutex_);
  frontends_[session] = std::move(receiver);
}

void InProcessTransport::disconnectFrontend(SessionId session) {
  const std::unique_lock lock(mutex_);
  frontends_.erase(session);
}

pipeline::PushResult InProcessTransport::send(Request request) {
  std::shared_ptr<pipeline::Inlet<Request>> receiver;
  {
    const std::shared_lock lock(mutex_);
    const auto it = backends_.find(request.visible().object.type);
    if (it != backends_.end()) receiver = it->second;
  }
  return receiver ? receiver->push(std::move(request)) : pipeline::PushResult::kClosed;
}

void InProcessTransport::send(Result result) {
  std::shared_ptr<pipeline::Inlet<Result>> receiver;
  {
    const std::shared_lock lock(mutex_);
    const auto it = frontends_.find(result.session);
    if (it != frontends_.end()) receiver = it->second.lock();
  }
  if (receiver) receiver->push(std::move(result));
}

}  // namespace grove::node
