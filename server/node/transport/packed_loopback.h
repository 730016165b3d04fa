#pragma once

#include <map>
#include <memory>
#include <shared_mutex>

#include "node/transport/in_process.h"
#include "node/transport/transport.h"
#include "pipeline/timeline.h"

namespace grove::node {

class Registry;

/// Frontend and backend nodes in one process that treat simulation data as if a wire were between them: it is packed
/// once for all visitors, and unpacked once by every frontend node that gets it, however many frames show it. Shows
/// what distribution costs; the bytes themselves, images, and data without a packed form travel by reference.
class PackedLoopback final : public Transport {
 public:
  /// The registry's types unpack; packing is recorded on the timeline. Both outlive the transport.
  PackedLoopback(const Registry& registry, pipeline::Timeline& timeline) : registry_(registry), timeline_(timeline) {}

  void connectBackend(world::TypeIndex type, std::shared_ptr<pipeline::Inlet<Request>> receiver) override;
  void connectFrontend(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver) override;
  void disconnectFrontend(SessionId session) override;
  pipeline::PushResult send(Request request) override;
  void send(Result result) override;
  [[nodiscard]] Payload compress(Payload payload) const override;

  /// Bytes that cannot be unpacked become a Failure.
  [[nodiscard]] Payload decompress(Payload payload) const override;

 private:
  class Unpacked;
  class Parcel;

  const Registry& registry_;
  pipeline::Timeline& timeline_;
  InProcessTransport local_;
  std::shared_mutex mutex_;
  std::map<SessionId, std::shared_ptr<Unpacked>> frontends_;
};

}  // namespace grove::node
