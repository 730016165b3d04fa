#pragma once

#include "node/frontend/frontend_half.h"

namespace grove::objects::mesh {

/// Meshes are pictures; the frontend only composites them.
class MeshFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& tools) const override;
};

}  // namespace grove::objects::mesh
