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

/// A world's owner that servers can join over gRPC, with a thread of its own for what they say. Any thread.
class OpenWorld {
 public:
  /// Listens there; throws EnvironmentError if it cannot. The scene is used during the call only.
  OpenWorld(const world::Scene& scene, const stream::HostPort& at, const node::LinkTls& tls);

  /// Where it listens, HOST:PORT.
  [[nodiscard]] const std::string& address() const noexcept { return address_; }

  /// A link of this process itself, without a socket. It goes before this does.
  [[nodiscard]] std::shared_ptr<node::FrontendEnd> link();

 private:
  pipeline::Timeline timeline_;
  pipeline::WorkerPool workers_;
  node::WorldOwner owner_;
  const node::GrpcServer server_;
  const std::string address_;
};

}  // namespace grove::cli
