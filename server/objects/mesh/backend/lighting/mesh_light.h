#pragma once

#include <vector>

#include "node/backend/backend_services.h"
#include "raster/surface.h"

namespace grove::objects::mesh {

/// From this many vertices on, which take about a second to bake, the light is stored in the cache folder.
inline constexpr std::size_t kMinKeptVertices = 50'000;

/// A mesh at its place in the world.
struct PlacedMesh {
  const raster::Surface* surface = nullptr;
  world::Mat4 toWorld{1.0F};
  bool shades = true;  ///< whether it shades the world; if not, it still shades itself
};

/// Returns the light at each vertex of each mesh, see raster::bakeLight(): from the cache if the same meshes stood in
/// the same world, else baked on the services' workers, so do not call it on one of them.
[[nodiscard]] std::vector<std::vector<world::Vec4>> lightOf(const std::vector<PlacedMesh>& meshes,
                                                            const node::BackendServices& services);

}  // namespace grove::objects::mesh
