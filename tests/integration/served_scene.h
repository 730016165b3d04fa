#pragma once

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/local/local_world.h"
#include "node/object_types.h"
#include "node/transport/grpc/dial_nodes.h"
#include "node/transport/transport_kind.h"
#include "objects/builtin.h"
#include "stream/session/host.h"
#include "world/scenes/scene_file.h"

namespace grove::integration {

/// A whole server without its sockets: a scene with the built-in object types and a host for visitors.
struct ServedScene {
  /// The transport is the one that the test program is to run over, if the test has none of its own. `nodes` are
  /// addresses of nodes in other processes, which serve some of the objects.
  explicit ServedScene(const std::string& scene, const stream::HostOptions& options = {},
                       node::TransportFactory transport = transportOfProgram(),
                       const std::vector<std::string>& nodes = {})
      : host(
            [&](const node::Machine& machine, const node::WorldNodes::Progress& progress) {
              node::LoadedScene loaded = node::loadScene(world::parseScene(scene, "test.toml"), types.backends);
              auto others = nodes.empty()
                                ? nullptr
                                : node::dialNodes(nodes, node::helloOf(options.process, loaded.layout),
                                                  std::chrono::seconds(10), machine.workers, machine.timeline);
              return std::make_unique<node::LocalWorld>(std::move(loaded), types.backends, gl, machine, progress,
                                                        transport, std::move(others));
            },
            types.frontends, patient(options), [](std::string_view, float) {}) {}

  /// Tests are about what a frame shows, not about how long a slow machine or a sanitizer takes for it, or what a busy
  /// one leaves out.
  static stream::HostOptions patient(stream::HostOptions options) {
    options.deadlineSeconds = stream::HostOptions::kNoHurry;
    options.load = pipeline::WorkerPool::kIgnored;
    return options;
  }
  static node::TransportFactory transportOfProgram() {
    const char* const asked = std::getenv("GROVE_TEST_TRANSPORT");
    if (asked == nullptr) return {};
    const bool isGrpc = std::string_view(asked) == "grpc";
    return node::transportFactory(isGrpc ? node::TransportKind::kGrpc : node::TransportKind::kBytes);
  }

  const node::ObjectTypes types = objects::builtinTypes();
  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders};
  stream::Host host;
};

}  // namespace grove::integration
