#pragma once

#include "node/backend/prepare/load_scene.h"

namespace grove::objects {

/// Returns the backend sides of all object types of this folder.
[[nodiscard]] node::BackendTypes builtinBackends();

}  // namespace grove::objects
