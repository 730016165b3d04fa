#pragma once

#include "node/frontend/frontend_half.h"
#include "node/type_table.h"

namespace grove::node {

using FrontendTypes = TypeTable<FrontendType>;

}  // namespace grove::node
