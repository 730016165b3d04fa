#pragma once

#include "node/transport/packets/packets.h"
#include "node/transport/sent_views.h"
#include "node/transport/transport.h"

namespace grove::node {

/// A frontend process's messages on their way to a backend node.
class PacketsToBackend final : public Packets<BackendPort> {
 public:
  /// `answers` gets the failures of requests that the node refuses, and outlives it.
  PacketsToBackend(pipeline::Executor& executor, pipeline::Timeline& timeline, BackendEnd& answers);

 protected:
  void deliver(const Packet& packet, BackendPort& port) override;

 private:
  BackendEnd& answers_;
  SentViews views_;
};

}  // namespace grove::node
