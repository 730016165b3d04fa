#pragma once

#include "node/frontend/frontend_types.h"

namespace grove::objects {

/// Returns the frontend sides of all object types of this folder.
[[nodiscard]] node::FrontendTypes builtinFrontends();

}  // namespace grove::objects
