#pragma once

#include <map>
#include <memory>
#include <shared_mutex>

#include "node/transport/transport.h"

namespace grove::node {

/// Frontend and backend nodes in one process: results travel by reference, so there is nothing to compress.
class InProcessTransport final : public Transport {
 public:
  void connectBackend(world::TypeIndex type, std::shared_ptr<pipeline::Inlet<Request>> receiver) override;
  void connectFrontend(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver) override;
  void disconnectFrontend(SessionId session) override;
  pipeline::PushResult send(Request request) override;
  void send(Result result) override;
  [[nodiscard]] Payload compress(Payload payload) const override { return payload; }
  [[nodiscard]] Payload decompress(Payload payload) const override { return payload; }

 private:
  std::shared_mutex mutex_;
  std::map<world::TypeIndex, std::shared_ptr<pipeline::Inlet<Request>>> backends_;
  std::map<SessionId, std::weak_ptr<pipeline::Inlet<Result>>> frontends_;
};

}  // namespace grove::node
