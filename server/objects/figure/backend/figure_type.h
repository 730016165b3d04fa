#pragma once

#include "node/object_type.h"

namespace grove::objects::figure {

/// Object type "figure": how visitors look to each other.
class FigureType final : public node::ObjectType {
 public:
  [[nodiscard]] std::string_view name() const override { return "figure"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeBackend(const node::BackendServices& services,
                                                               world::TypeIndex self) const override;
  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeFrontend() const override;
};

}  // namespace grove::objects::figure
