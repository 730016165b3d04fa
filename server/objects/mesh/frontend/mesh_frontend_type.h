#pragma once

#include <memory>

#include "node/frontend/frontend_half.h"

namespace grove::objects::mesh {

/// Meshes are pictures; the frontend only composites them.
[[nodiscard]] std::unique_ptr<node::FrontendType> frontendType();

}  // namespace grove::objects::mesh
