#pragma once

#include <memory>

#include "node/frontend/frontend_half.h"

namespace grove::objects::herd {

/// Draws the newest herd's animals, and their shadows, into each visitor's frame.
[[nodiscard]] std::unique_ptr<node::FrontendType> frontendType();

}  // namespace grove::objects::herd
