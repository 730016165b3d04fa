#pragma once

#include "node/backend/prepare/load_scene.h"

namespace grove::objects {

/// What a backend node knows of the object types of this folder.
[[nodiscard]] node::BackendTypes builtinBackends();

}  // namespace grove::objects
