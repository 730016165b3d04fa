#pragma once

#include "node/transport/packets/packets.h"
#include "node/transport/transport.h"

namespace grove::node {

/// A backend node's messages on their way to a frontend process.
class PacketsToFrontend final : public Packets<FrontendPort> {
 public:
  PacketsToFrontend(pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void deliver(const Packet& packet, FrontendPort& port) override;
};

}  // namespace grove::node
