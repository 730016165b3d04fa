#include "node/transport/packets_to_backend.h"

#include <utility>

namespace grove::node {

PacketsToBackend::PacketsToBackend(pipeline::Executor& executor, pipeline::Timeline& timeline, BackendEnd& answers)
    : Packets({.name = "Backend Link",
               .work = pipeline::Work::kPerUserBackend,
               .capacity = kBackendQueue,
               .maxBatch = kBackendBatch,
               .finishes = true},
              executor, timeline),
      answers_(answers) {}

void PacketsToBackend::deliver(const Packet& packet, BackendPort& port) {
  auto decoded = decodeToBackend(packet.header, views_.lookup());
  if (const auto* error = std::get_if<WireError>(&decoded)) {
    refuse(*error);
    return;
  }
  auto& message = std::get<ToBackend>(decoded);
  if (const auto* view = std::get_if<std::shared_ptr<const View>>(&message)) views_.add(*view);
  if (const auto* forgotten = std::get_if<Forget>(&message)) views_.forget(forgotten->session);
  const auto* const request = std::get_if<Request>(&message);
  Result refusal = request == nullptr ? Result{} : resultOf(*request, Failure{"the backend node is full", true});
  const bool isRequest = request != nullptr;
  if (port.receive(std::move(message)) != pipeline::PushResult::kAccepted && isRequest) {
    answers_.send(ToFrontend(std::move(refusal)));
  }
}

}  // namespace grove::node
