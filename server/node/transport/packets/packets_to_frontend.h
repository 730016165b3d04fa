#pragma once

#include "node/transport/packets/packets.h"
#include "node/transport/transport.h"

namespace grove::node {

/// What a backend node sends, on its way to a frontend process.
class PacketsToFrontend final : public Packets<FrontendPort> {
 public:
  PacketsToFrontend(pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void deliver(const Packet& packet, FrontendPort& port) override;
};

}  // namespace grove::node
