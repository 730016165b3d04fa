#pragma once

#include <memory>
#include <string>

#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/registry.h"
#include "objects/builtin.h"
#include "stream/session/host.h"
#include "world/scene_file.h"

namespace grove::integration {

/// A whole server without its sockets: a scene with the built-in object types and a host for visitors.
struct ServedScene {
  explicit ServedScene(const std::string& scene, const stream::HostOptions& options = {},
                       const objects::BuiltinOptions& builtin = {})
      : host(node::makeLayout(world::parseScene(scene, "test.toml"), registered(builtin)), registry, gl,
             patient(options), [](std::string_view, float) {}) {}

  /// Tests are about what a frame shows, not about how long a slow machine or a sanitizer takes for it.
  static stream::HostOptions patient(stream::HostOptions options) {
    options.deadlineSeconds = stream::HostOptions::kNoHurry;
    return options;
  }

  const node::Registry& registered(const objects::BuiltinOptions& builtin) {
    objects::registerBuiltinTypes(registry, builtin);
    return registry;
  }

  node::Registry registry;
  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders};
  stream::Host host;
};

}  // namespace grove::integration
