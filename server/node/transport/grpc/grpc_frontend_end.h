#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"
#include "node/transport/transport.h"
#include "pipeline/executor.h"
#include "pipeline/timeline.h"

namespace grove::node {

class ReconnectingLink;

/// A frontend process's end of a gRPC link to a backend node in another process. Connects in the background.
/// Reconnects after a lost link with exponential backoff (0.1 s to 1 s) and jitter. A new stream starts with the last
/// hello, world update and quality. While there is no stream, send() refuses all messages. Thread-safe.
class GrpcFrontendEnd final : public FrontendEnd {
 public:
  using State = LinkState;
  using Status = LinkStatus;

  /// To the node at HOST:PORT; over TLS, and only to a node whose certificate is trusted and names HOST, if `tls` says
  /// whose are. The log names the node by its `role` and address. Workers and timeline outlive it.
  GrpcFrontendEnd(std::string address, pipeline::Executor& executor, pipeline::Timeline& timeline, LinkTls tls = {},
                  const std::string& role = "node");
  /// Waits for the end of the stream, so not on one of gRPC's threads.
  ~GrpcFrontendEnd() override;
  GrpcFrontendEnd(const GrpcFrontendEnd&) = delete;
  GrpcFrontendEnd& operator=(const GrpcFrontendEnd&) = delete;

  void connect(FrontendPort& frontend) override;
  void leaveFrontend() override;
  pipeline::PushResult send(ToBackend message) override;
  [[nodiscard]] LinkTraffic traffic() const override;

  [[nodiscard]] Status status() const override;
  [[nodiscard]] LinkPace pace() const override;
  /// The status once the node has welcomed or refused, or after so long.
  [[nodiscard]] Status waitForAnswer(std::chrono::milliseconds max) const;
  /// Until what is sent goes on its way; false if that takes longer.
  [[nodiscard]] bool waitUntilOpen(std::chrono::milliseconds max) const;

 private:
  const std::shared_ptr<ReconnectingLink> link_;
};

}  // namespace grove::node
