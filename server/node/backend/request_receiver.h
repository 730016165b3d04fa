#pragma once

#include "node/backend/peers/peer_request.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Takes requests from the transport and passes them to the Renderer or the Simulator (section 4.2, step 3). Each
/// frontend process has a queue here, and the queues take turns.
class RequestReceiver final : public pipeline::Stage<PeerRequest> {
 public:
  RequestReceiver(pipeline::Executor& executor, pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<PeerRequest>> handler);

 protected:
  void process(std::span<PeerRequest> requests, pipeline::Run& run) override;

 private:
  pipeline::Outlet<PeerRequest> handler_;
};

}  // namespace grove::node
