#pragma once

#include <shared_mutex>
#include <string_view>

#include "node/transport/transport.h"

namespace grove::node {

/// Both ends in one process: messages travel by reference, so there is nothing to compress and nothing to copy.
class ReferenceTransport final : public Transport {
 public:
  using Transport::connect;
  using Transport::send;
  [[nodiscard]] bool sharesMemory() const override { return true; }
  void connect(BackendPort& backend) override;
  void connect(FrontendPort& frontend) override;
  void leaveBackend() override;
  void leaveFrontend() override;
  pipeline::PushResult send(ToBackend message) override;
  void send(ToFrontend message) override;
  void compress(Result& /*result*/, std::string_view /*subject*/) const override {}

 private:
  std::shared_mutex backendMutex_;  ///< held shared while a port is in use, so that nobody leaves it meanwhile
  BackendPort* backend_ = nullptr;
  std::shared_mutex frontendMutex_;
  FrontendPort* frontend_ = nullptr;
};

}  // namespace grove::node
