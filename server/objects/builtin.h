#pragma once

#include "node/object_types.h"
#include "objects/builtin_backends.h"

namespace grove::objects {

/// What a process knows of the object types of this folder that is both a frontend and a backend.
[[nodiscard]] node::ObjectTypes builtinTypes();

}  // namespace grove::objects
