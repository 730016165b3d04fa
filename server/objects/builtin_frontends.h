#pragma once

#include "node/frontend/frontend_types.h"

namespace grove::objects {

/// What a frontend process knows of the object types of this folder.
[[nodiscard]] node::FrontendTypes builtinFrontends();

}  // namespace grove::objects
