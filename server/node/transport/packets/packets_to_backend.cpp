#include "node/transport/packets/packets_to_backend.h"

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
  const ToBackend message = std::get<ToBackend>(std::move(decoded));
  const bool isAccepted = port.receive(message) == pipeline::PushResult::kAccepted;
  if (const auto* request = std::get_if<Request>(&message); request != nullptr && !isAccepted) {
    answers_.send(ToFrontend(resultOf(*request, Failure{"the backend node is full", true})));
  }
  if (!isAccepted) return;
  if (const auto* view = std::get_if<std::shared_ptr<const View>>(&message)) views_.add(*view);
  if (const auto* forgotten = std::get_if<Forget>(&message)) views_.forget(forgotten->session);
}

}  // namespace grove::node
