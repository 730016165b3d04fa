#include "node/transport/packets/packets_to_frontend.h"

#include <utility>

namespace grove::node {

PacketsToFrontend::PacketsToFrontend(pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Packets({.name = "Frontend Link",
               .work = pipeline::Work::kPerUserFrontend,
               .capacity = kBackendQueue,
               .maxBatch = kBackendBatch,
               .finishes = true},
              executor, timeline) {}

void PacketsToFrontend::deliver(const Packet& packet, FrontendPort& port) {
  auto decoded = decodeToFrontend(packet);
  if (const auto* error = std::get_if<WireError>(&decoded)) {
    refuse(*error);
  } else {
    port.receive(std::move(std::get<ToFrontend>(decoded)));
  }
}

}  // namespace grove::node
