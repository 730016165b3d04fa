#pragma once

#include <memory>
#include <string>

#include "node/transport/grpc/grpc_server.h"
#include "node/transport/grpc/tls/link_tls.h"
#include "node/world/world_owner.h"
#include "pipeline/timeline.h"
#include "pipeline/worker_pool.h"
#include "stream/web_server/listen_address.h"
#include "world/scenes/scene_file.h"

namespace grove::cli {

/// A world's owner that servers can join over gRPC, with its own thread for their messages. Any thread.
class OpenWorld {
 public:
  /// Listens at `at`; throws EnvironmentError if that fails. Uses the scene during the call only.
  OpenWorld(const world::Scene& scene, const stream::HostPort& at, const node::LinkTls& tls);

  /// The address that it listens at, HOST:PORT.
  [[nodiscard]] const std::string& address() const noexcept { return address_; }

  /// Returns a link within this process, without a socket. It must be destroyed before this.
  [[nodiscard]] std::shared_ptr<node::FrontendEnd> link();

 private:
  pipeline::Timeline timeline_;
  pipeline::WorkerPool workers_;
  node::WorldOwner owner_;
  const node::GrpcServer server_;
  const std::string address_;
};

}  // namespace grove::cli
