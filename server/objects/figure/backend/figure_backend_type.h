#pragma once

#include "node/backend/backend_half.h"

namespace grove::objects::figure {

/// Object type "figure": the visitors as they look to each other.
class FigureBackendType final : public node::BackendType {
 public:
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex self) const override;
};

}  // namespace grove::objects::figure
