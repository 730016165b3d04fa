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

  /// Links to the node at HOST:PORT. With `tls.trusted`, over TLS and only to a node whose certificate is trusted and
  /// names HOST. Log lines name the node by `role` and address. Workers and timeline outlive it.
  GrpcFrontendEnd(std::string address, pipeline::Executor& executor, pipeline::Timeline& timeline, LinkTls tls = {},
                  const std::string& role = "node");
  /// Waits for the end of the stream, so it must not run on gRPC's threads.
  ~GrpcFrontendEnd() override;
  GrpcFrontendEnd(const GrpcFrontendEnd&) = delete;
  GrpcFrontendEnd& operator=(const GrpcFrontendEnd&) = delete;

  void connect(FrontendPort& frontend) override;
  void leaveFrontend() override;
  pipeline::PushResult send(ToBackend message) override;
  [[nodiscard]] LinkTraffic traffic() const override;

  [[nodiscard]] Status status() const override;
  [[nodiscard]] LinkPace pace() const override;
  /// Waits, for at most `max`, until the node has welcomed or refused; returns the status.
  [[nodiscard]] Status waitForAnswer(std::chrono::milliseconds max) const;
  /// Waits until messages can be sent; false if that takes longer than `max`.
  [[nodiscard]] bool waitUntilOpen(std::chrono::milliseconds max) const;

 private:
  const std::shared_ptr<ReconnectingLink> link_;
};

}  // namespace grove::node
