#pragma once

#include "node/registry.h"
#include "objects/lightfield/backend/light_field_type.h"

namespace grove::objects {

/// What the server may choose of the object types.
struct BuiltinOptions {
  lightfield::ViewCacheOptions viewCache;
  lightfield::KnownFields lightFields;
};

/// Makes the object types of this folder known. The one place where they are all named.
void registerBuiltinTypes(node::Registry& registry, const BuiltinOptions& options = {});

}  // namespace grove::objects
