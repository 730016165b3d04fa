#pragma once

#include "node/backend/prepare/load_scene.h"
#include "node/frontend/frontend_types.h"

namespace grove::node {

/// The object types of a process that is both a frontend and a backend.
struct ObjectTypes {
  BackendTypes backends;
  FrontendTypes frontends;
};

}  // namespace grove::node
