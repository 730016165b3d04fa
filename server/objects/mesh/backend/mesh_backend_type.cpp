#include "objects/mesh/backend/mesh_backend_type.h"

#include "objects/mesh/backend/mesh_backend.h"
#include "objects/mesh/backend/mesh_model.h"
#include "objects/mesh/common/mesh_name.h"

namespace grove::objects::mesh {

std::string_view MeshBackendType::name() const { return kTypeName; }

std::shared_ptr<const world::Model> MeshBackendType::model(const world::Parameters& parameters) const {
  return std::make_shared<MeshModel>(parameters);
}

std::unique_ptr<node::BackendHalf> MeshBackendType::makeHalf(const node::BackendServices& services,
                                                             world::TypeIndex self) const {
  return std::make_unique<MeshBackend>(services, self);
}

}  // namespace grove::objects::mesh
