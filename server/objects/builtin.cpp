#include "objects/builtin.h"

#include "objects/builtin_frontends.h"

namespace grove::objects {

node::ObjectTypes builtinTypes(const BuiltinOptions& options) { return {builtinBackends(options), builtinFrontends()}; }

}  // namespace grove::objects
