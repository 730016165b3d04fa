#pragma once

#include <string_view>

#include "node/transport/connection.h"
#include "node/transport/transport.h"

namespace grove::node {

/// Both ends in one process: messages travel by reference, without compression or copies.
class ReferenceTransport final : public Transport {
 public:
  using Transport::connect;
  using Transport::send;
  [[nodiscard]] bool sharesMemory() const override { return true; }
  void connect(BackendPort& backend) override { backend_.connect(backend); }
  void connect(FrontendPort& frontend) override { frontend_.connect(frontend); }
  void leaveBackend() override { backend_.leave(); }
  void leaveFrontend() override { frontend_.leave(); }
  pipeline::PushResult send(ToBackend message) override;
  pipeline::PushResult send(ToFrontend message) override;
  void compress(Result& /*result*/, std::string_view /*subject*/) const override {}

 private:
  Connection<BackendPort> backend_;
  Connection<FrontendPort> frontend_;
};

}  // namespace grove::node
