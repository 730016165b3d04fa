#include "objects/mesh/frontend/mesh_frontend_type.h"

#include "objects/mesh/common/mesh_name.h"

namespace grove::objects::mesh {
namespace {

class MeshFrontend final : public node::FrontendHalf {
 public:
  [[nodiscard]] std::optional<float> stillDistance(const node::VisibleObject& object, world::Vec3 eye) const override {
    return object.object.bounds.distance(eye);
  }
};

class MeshFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return kTypeName; }

  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& /*tools*/) const override {
    return std::make_unique<MeshFrontend>();
  }
};

}  // namespace

std::unique_ptr<node::FrontendType> frontendType() { return std::make_unique<MeshFrontendType>(); }

}  // namespace grove::objects::mesh
