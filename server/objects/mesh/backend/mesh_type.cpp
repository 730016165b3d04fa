#include "objects/mesh/backend/mesh_type.h"

#include "objects/mesh/backend/mesh_backend.h"
#include "objects/mesh/backend/mesh_model.h"

namespace grove::objects::mesh {

std::shared_ptr<const world::Model> MeshType::model(const world::Parameters& parameters) const {
  return std::make_shared<MeshModel>(parameters);
}

std::unique_ptr<node::BackendHalf> MeshType::makeBackend(const node::BackendServices& services,
                                                         world::TypeIndex self) const {
  return std::make_unique<MeshBackend>(services, self);
}

}  // namespace grove::objects::mesh
