#pragma once

#include <memory>

#include "node/frontend/frontend_half.h"

namespace grove::objects::ground {

/// Grows the grass in each visitor's view.
[[nodiscard]] std::unique_ptr<node::FrontendType> frontendType();

}  // namespace grove::objects::ground
