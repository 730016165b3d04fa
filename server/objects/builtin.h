#pragma once

#include "node/object_types.h"
#include "objects/builtin_backends.h"

namespace grove::objects {

/// Returns all object types of this folder for a process that is both a frontend and a backend.
[[nodiscard]] node::ObjectTypes builtinTypes();

}  // namespace grove::objects
