#include "objects/builtin.h"

#include <memory>

#include "objects/figure/backend/figure_type.h"
#include "objects/fluid/backend/fluid_type.h"
#include "objects/ground/backend/ground_type.h"
#include "objects/lightfield/backend/light_field_type.h"
#include "objects/mesh/backend/mesh_type.h"
#include "objects/sky/backend/sky_type.h"

namespace grove::objects {

void registerBuiltinTypes(node::Registry& registry, const BuiltinOptions& options) {
  registry.add(std::make_unique<figure::FigureType>());
  registry.add(std::make_unique<fluid::FluidType>());
  registry.add(std::make_unique<ground::GroundType>());
  registry.add(std::make_unique<lightfield::LightFieldType>(options.viewCache, options.lightFields));
  registry.add(std::make_unique<mesh::MeshType>());
  registry.add(std::make_unique<sky::SkyType>());
}

}  // namespace grove::objects
