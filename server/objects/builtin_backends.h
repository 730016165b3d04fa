#pragma once

#include "node/backend/prepare/load_scene.h"
#include "objects/lightfield/backend/light_field_backend_type.h"

namespace grove::objects {

/// What the server may choose of the object types.
struct BuiltinOptions {
  lightfield::LightFieldOptions lightField;
};

/// What a backend node knows of the object types of this folder.
[[nodiscard]] node::BackendTypes builtinBackends(const BuiltinOptions& options = {});

}  // namespace grove::objects
