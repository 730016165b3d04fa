#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string_view>

#include "node/transport/grpc/grpc_frontend_end.h"
#include "node/transport/grpc/grpc_server.h"
#include "node/transport/transport.h"

namespace grove::node {

/// Both ends of a gRPC link in one process, with a local socket between them, for benches and tests.
class GrpcTransport final : public Transport {
 public:
  /// Both outlive it. Throws EnvironmentError if the ends cannot connect.
  GrpcTransport(pipeline::Executor& executor, pipeline::Timeline& timeline);

  [[nodiscard]] bool sharesMemory() const override { return false; }
  void connect(BackendPort& backend) override;
  void connect(FrontendPort& frontend) override { frontend_.connect(frontend); }
  void leaveBackend() override;
  void leaveFrontend() override { frontend_.leaveFrontend(); }
  pipeline::PushResult send(ToBackend message) override;
  pipeline::PushResult send(ToFrontend message) override;
  void compress(Result& result, std::string_view subject) const override { backend()->compress(result, subject); }
  [[nodiscard]] LinkTraffic traffic() const override { return frontend_.traffic(); }

 private:
  void accept(std::shared_ptr<BackendEnd> backend);
  [[nodiscard]] std::shared_ptr<BackendEnd> backend() const;

  mutable std::mutex mutex_;
  std::condition_variable accepted_;
  BackendPort* port_ = nullptr;
  std::shared_ptr<BackendEnd> backend_;  ///< of the newest stream
  GrpcServer server_;
  GrpcFrontendEnd frontend_;
};

}  // namespace grove::node
