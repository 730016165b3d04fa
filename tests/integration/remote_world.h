#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "node/frontend/frontend_process.h"
#include "node/frontend/frontend_types.h"
#include "node/frontend/remote_world.h"
#include "node/transport/grpc/dial_nodes.h"
#include "world/scenes/scene_layout.h"

namespace grove::integration {

/// A scene that nodes in other processes serve, at these addresses. The types outlive it.
inline node::WorldNodesFactory remoteWorld(const std::string& scene, const node::FrontendTypes& types,
                                           const std::vector<std::string>& nodes, node::ProcessId process = 1,
                                           const node::LinkTls& tls = {}) {
  return [=, &types](const node::Machine& machine, const node::WorldNodes::Progress&) {
    world::Layout layout = world::layoutOf(world::parseScene(scene, "test.toml"), types.names());
    auto links = node::dialNodes(nodes, node::helloOf(process, layout), std::chrono::seconds(10), machine.workers,
                                 machine.timeline, tls);
    return std::make_unique<node::RemoteWorld>(std::move(layout), std::move(links));
  };
}

}  // namespace grove::integration
