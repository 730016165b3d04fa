#include "raster/box.h"

namespace grove::raster {

Surface makeBox(world::Vec3 size, world::Vec3 albedo) {
  return makeDeformedBox({4, 4, 4}, 0, [&](world::Vec3 cube) {
    Vertex vertex;
    vertex.position = (cube * 0.5F + world::Vec3(0.0F, 0.5F, 0.0F)) * size;
    vertex.albedo = albedo;
    return vertex;
  });
}

}  // namespace grove::raster
