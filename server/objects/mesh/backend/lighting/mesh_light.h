#pragma once

#include <vector>

#include "node/backend/backend_services.h"
#include "raster/surface.h"

namespace grove::objects::mesh {

/// From so many vertices on, which take about a second, the light is kept in the cache folder.
inline constexpr std::size_t kMinKeptVertices = 50'000;

/// A mesh where it stands.
struct PlacedMesh {
  const raster::Surface* surface = nullptr;
  world::Mat4 toWorld{1.0F};
  bool shades = true;  ///< the world; one that is not among what does still shades itself
};

/// The light at each vertex of each mesh, see raster::bakeLight(): as it was kept when the same meshes stood in the
/// same world, or baked on the services' workers, so not to be called on one of those.
[[nodiscard]] std::vector<std::vector<world::Vec4>> lightOf(const std::vector<PlacedMesh>& meshes,
                                                            const node::BackendServices& services);

}  // namespace grove::objects::mesh
