#include "cli/open_world.h"

#include <memory>
#include <utility>

#include "cli/host_port.h"

namespace grove::cli {

OpenWorld::OpenWorld(const world::Scene& scene, const stream::HostPort& at)
    : workers_(1, "grove-world"),
      owner_(scene.hash, scene.radius),
      server_(
          addressOf(at, at.port),
          [this](std::shared_ptr<node::BackendEnd> link) { return owner_.accept(std::move(link)); }, workers_,
          timeline_),
      address_(addressOf(at, server_.port())) {}

}  // namespace grove::cli
