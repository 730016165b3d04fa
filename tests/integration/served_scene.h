#pragma once

#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/object_types.h"
#include "node/transport/transport_kind.h"
#include "objects/builtin.h"
#include "stream/session/host.h"
#include "world/scenes/scene_file.h"

namespace grove::integration {

/// A whole server without its sockets: a scene with the built-in object types and a host for visitors.
struct ServedScene {
  explicit ServedScene(const std::string& scene, const stream::HostOptions& options = {})
      : host(node::loadScene(world::parseScene(scene, "test.toml"), types.backends), types, gl, patient(options),
             [](std::string_view, float) {}) {}

  /// Tests are about what a frame shows, not about how long a slow machine or a sanitizer takes for it.
  /// The transport is the one that the test program is to run over, if the test has none of its own.
  static stream::HostOptions patient(stream::HostOptions options) {
    options.deadlineSeconds = stream::HostOptions::kNoHurry;
    const char* const asked = std::getenv("GROVE_TEST_TRANSPORT");
    if (!options.makeTransport && asked != nullptr) {
      const bool isGrpc = std::string_view(asked) == "grpc";
      options.makeTransport = node::transportFactory(isGrpc ? node::TransportKind::kGrpc : node::TransportKind::kBytes);
    }
    return options;
  }

  const node::ObjectTypes types = objects::builtinTypes();
  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders};
  stream::Host host;
};

}  // namespace grove::integration
