#pragma once

#include <memory>

#include "node/frontend/frontend_half.h"

namespace grove::objects::fluid {

/// Draws the newest smoke into each visitor's finished frame.
[[nodiscard]] std::unique_ptr<node::FrontendType> frontendType();

}  // namespace grove::objects::fluid
