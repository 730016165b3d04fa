#pragma once

#include "node/registry.h"

namespace grove::objects {

/// Makes the object types of this folder known. The one place where they are all named.
void registerBuiltinTypes(node::Registry& registry);

}  // namespace grove::objects
