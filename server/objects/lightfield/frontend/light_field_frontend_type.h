#pragma once

#include <memory>

#include "node/frontend/frontend_half.h"

namespace grove::objects::lightfield {

[[nodiscard]] std::unique_ptr<node::FrontendType> frontendType();

}  // namespace grove::objects::lightfield
