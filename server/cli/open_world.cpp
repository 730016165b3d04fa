#include "cli/open_world.h"

#include <memory>
#include <utility>

#include "cli/options/host_port.h"
#include "node/transport/reference_transport.h"

namespace grove::cli {

OpenWorld::OpenWorld(const world::Scene& scene, const stream::HostPort& at, const node::LinkTls& tls)
    : workers_(1, "grove-world"),
      owner_(scene.hash, scene.radius),
      server_(
          addressOf(at, at.port),
          [this](std::shared_ptr<node::BackendEnd> link) { return owner_.accept(std::move(link)); }, workers_,
          timeline_, tls),
      address_(addressOf(at, server_.port())) {}

std::shared_ptr<node::FrontendEnd> OpenWorld::link() {
  struct Served {
    std::shared_ptr<node::ReferenceTransport> transport;
    std::shared_ptr<void> token;
  };
  const auto transport = std::make_shared<node::ReferenceTransport>();
  const auto served = std::make_shared<Served>(Served{transport, owner_.accept(transport)});
  return {served, transport.get()};
}

}  // namespace grove::cli
