#include "objects/mesh/frontend/mesh_frontend_type.h"

#include "objects/mesh/common/mesh_name.h"

namespace grove::objects::mesh {

std::string_view MeshFrontendType::name() const { return kTypeName; }

}  // namespace grove::objects::mesh
