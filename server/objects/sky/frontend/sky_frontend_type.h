#pragma once

#include <memory>

#include "node/frontend/frontend_half.h"

namespace grove::objects::sky {

/// Shows each visitor their part of the panorama, behind everything.
[[nodiscard]] std::unique_ptr<node::FrontendType> frontendType();

}  // namespace grove::objects::sky
