#pragma once

#include <memory>

#include "node/frontend/frontend_half.h"

namespace grove::objects::figure {

[[nodiscard]] std::unique_ptr<node::FrontendType> frontendType();

}  // namespace grove::objects::figure
