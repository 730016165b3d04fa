#pragma once

#include <cstddef>
#include <span>

#include "raster/surface.h"
#include "world/ground/hills.h"
#include "world/rays/ray_scene.h"
#include "world/sky.h"

namespace grove::raster {

/// Occluders of a surface, in world coordinates.
struct Obstacles {
  const world::RayScene& world;
  const world::RayScene* own = nullptr;     ///< the surface itself, if it is not part of the world's; else null
  std::span<const world::Hill> hills = {};  ///< that the ground below is made of
};

/// Computes the light of sun, sky and ground at the surface's vertices from `begin` on, as many as `light` has, with
/// all obstacles and above the ground; see LitSurface. About 70 rays per vertex.
void bakeLight(const Surface& surface, const world::Mat4& toWorld, const world::Sky& sky, const Obstacles& obstacles,
               std::size_t begin, std::span<world::Vec4> light);

/// The share of the sun in the direction `sun` that reaches a point: 0..1.
[[nodiscard]] float sunAt(world::Vec3 point, world::Vec3 sun, const world::RayScene& solids);

}  // namespace grove::raster
