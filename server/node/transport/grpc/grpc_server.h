#pragma once

#include <functional>
#include <memory>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"
#include "node/transport/obstacle_answers.h"
#include "node/transport/transport.h"
#include "pipeline/executor.h"
#include "pipeline/timeline.h"

namespace grove::node {

/// Accepts frontend processes over gRPC and passes on each link. Also serves the standard health service, for all
/// clients, and other nodes' requests for obstacles. At most kMaxLinks links at a time; a broken link does not affect
/// the others.
class GrpcServer {
 public:
  /// Serves the process at the other end until the returned token is destroyed, see BackendNode::accept(). Runs on
  /// gRPC's threads; an exception closes the link.
  using Accept = std::function<std::shared_ptr<void>(std::shared_ptr<BackendEnd>)>;
  static constexpr int kMaxLinks = 64;

  /// Listens at HOST:PORT; port 0 selects any free port. Over TLS if there is a certificate, and then, if `tls` names
  /// authorities, only for processes whose certificates they have signed. Throws EnvironmentError if it cannot listen.
  /// Workers and timeline outlive it. `obstacles`: null if this process has no models.
  GrpcServer(const std::string& address, Accept accept, pipeline::Executor& executor, pipeline::Timeline& timeline,
             const LinkTls& tls = {}, std::shared_ptr<ObstacleAnswers> obstacles = nullptr);
  /// Ends all links and waits until the tokens of accept() are destroyed; so it must not run on one of the executor's
  /// threads.
  ~GrpcServer();
  GrpcServer(const GrpcServer&) = delete;
  GrpcServer& operator=(const GrpcServer&) = delete;

  [[nodiscard]] int port() const noexcept;

 private:
  class Service;
  class Link;
  struct Parts;
  const std::unique_ptr<Parts> parts_;
};

}  // namespace grove::node
