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

/// Listens for frontend processes over gRPC, and gives each link to who serves it. Beside it there is the standard
/// health service, which answers everybody, and what answers other nodes' questions about obstacles. At most kMaxLinks
/// at a time; one that breaks costs the others nothing.
class GrpcServer {
 public:
  /// Serves the process at the other end until what it returns is destroyed, see BackendNode::accept(). On gRPC's
  /// threads; a throw costs that process its link.
  using Accept = std::function<std::shared_ptr<void>(std::shared_ptr<BackendEnd>)>;
  static constexpr int kMaxLinks = 64;

  /// Listens at HOST:PORT; port 0 is any free one. Over TLS if there is a certificate, and then only for processes
  /// whose certificates are trusted, if `tls` says which are. Throws EnvironmentError if it cannot. Workers and
  /// timeline outlive it. `obstacles`: null if this process has no models.
  GrpcServer(const std::string& address, Accept accept, pipeline::Executor& executor, pipeline::Timeline& timeline,
             const LinkTls& tls = {}, std::shared_ptr<ObstacleAnswers> obstacles = nullptr);
  /// Ends all links, and waits until what accept() returned is destroyed; so not on one of the executor's threads.
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
