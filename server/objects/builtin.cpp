#include "objects/builtin.h"

#include "objects/builtin_frontends.h"

namespace grove::objects {

node::ObjectTypes builtinTypes() { return {builtinBackends(), builtinFrontends()}; }

}  // namespace grove::objects
