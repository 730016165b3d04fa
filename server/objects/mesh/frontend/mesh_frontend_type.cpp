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

}  // namespace

std::string_view MeshFrontendType::name() const { return kTypeName; }

std::unique_ptr<node::FrontendHalf> MeshFrontendType::makeHalf(const node::FrontendTools& /*tools*/) const {
  return std::make_unique<MeshFrontend>();
}

}  // namespace grove::objects::mesh
