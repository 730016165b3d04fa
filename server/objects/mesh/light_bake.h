#pragma once

#include <vector>

#include "objects/mesh/surface.h"
#include "world/ray_scene.h"

namespace grove::objects::mesh {

/// The light of sun, sky and ground at each vertex, behind everything solid in the world and above the ground y = 0;
/// see LitSurface. About 70 rays a vertex.
[[nodiscard]] std::vector<world::Vec4> bakeLight(const Surface& surface, const world::Mat4& toWorld,
                                                 const world::RayScene& solids);

/// The share of the sun that reaches a point, 0..1.
[[nodiscard]] float sunAt(world::Vec3 point, const world::RayScene& solids);

}  // namespace grove::objects::mesh
