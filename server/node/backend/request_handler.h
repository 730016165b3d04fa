#pragma once

#include <string_view>

#include "node/backend/backend_half.h"
#include "node/backend/peers/peer_request.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Common part of Renderer and Simulator: passes a batch of requests to the object type's backend half and the results
/// on; a Failure where the half threw. One failing request does not affect the others of its batch. A request whose
/// frame has ended fails at once, so a slow half has no backlog.
class RequestHandler : public pipeline::Stage<PeerRequest> {
 public:
  void connect(std::shared_ptr<pipeline::Inlet<PeerResult>> compressor);

 protected:
  /// `subject`: the type of object, for the timeline.
  RequestHandler(const char* name, std::string_view subject, BackendHalf& half, pipeline::Timeline& timeline);
  void process(std::span<PeerRequest> all, pipeline::Run& run) final;

 private:
  /// Retries after the batch threw `reason`: only requests that throw again fail.
  void answerOneByOne(std::span<const Request> requests, std::span<Payload> payloads, const std::string& reason);

  pipeline::Timeline& timeline_;
  BackendHalf& half_;
  pipeline::Outlet<PeerResult> compressor_;
};

}  // namespace grove::node
