#pragma once

#include "node/object_type.h"

namespace grove::objects::mesh {

/// Object type "mesh": triangles drawn by a rendering node, composited by depth.
class MeshType final : public node::ObjectType {
 public:
  [[nodiscard]] std::string_view name() const override { return "mesh"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeBackend(const node::BackendServices& services,
                                                               world::TypeIndex self) const override;
};

}  // namespace grove::objects::mesh
