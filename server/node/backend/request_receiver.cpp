#include "node/backend/request_receiver.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

RequestReceiver::RequestReceiver(pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Request Receiver",
             .work = pipeline::Work::kPerUserBackend,
             .capacity = kBackendQueue,
             .maxBatch = kBackendBatch},
            executor, timeline) {}

void RequestReceiver::connect(std::shared_ptr<pipeline::Inlet<PeerRequest>> handler) {
  handler_.connect(std::move(handler));
  addOutlet(handler_);
}

void RequestReceiver::process(std::span<PeerRequest> requests, pipeline::Run& run) {
  for (PeerRequest& request : requests) handler_.send(run, std::move(request));
}

}  // namespace grove::node
