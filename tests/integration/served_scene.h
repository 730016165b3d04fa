#pragma once

#include <memory>
#include <string>

#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/object_types.h"
#include "objects/builtin.h"
#include "stream/session/host.h"
#include "world/scene_file.h"

namespace grove::integration {

/// A whole server without its sockets: a scene with the built-in object types and a host for visitors.
struct ServedScene {
  explicit ServedScene(const std::string& scene, const stream::HostOptions& options = {},
                       const objects::BuiltinOptions& builtin = {})
      : types(objects::builtinTypes(builtin)),
        host(node::loadScene(world::parseScene(scene, "test.toml"), types.backends), types, gl, patient(options),
             [](std::string_view, float) {}) {}

  /// Tests are about what a frame shows, not about how long a slow machine or a sanitizer takes for it.
  static stream::HostOptions patient(stream::HostOptions options) {
    options.deadlineSeconds = stream::HostOptions::kNoHurry;
    return options;
  }

  const node::ObjectTypes types;
  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders};
  stream::Host host;
};

}  // namespace grove::integration
