#include "node/transport/packets_to_frontend.h"

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
  // The copy that a socket would make.
  const auto bulk = packet.bulk ? std::make_shared<const PackedBytes>(*packet.bulk) : nullptr;
  auto decoded = decodeToFrontend({packet.header, bulk});
  if (const auto* error = std::get_if<WireError>(&decoded)) {
    refuse(*error);
  } else {
    port.receive(std::move(std::get<ToFrontend>(decoded)));
  }
}

}  // namespace grove::node
