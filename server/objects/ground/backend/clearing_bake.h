#pragma once

#include <functional>

#include "objects/ground/common/clearing.h"
#include "world/geometry.h"
#include "world/rays/ray_scene.h"

namespace grove::objects::ground {

struct ClearingOptions {
  int size = 2048;                        ///< texels a side, a power of two
  float metres = 160.0F;                  ///< side of the square
  float hearth = 2.6F;                    ///< metres of trodden earth around the fire at the origin
  world::Vec3 pathTo{0.0F, 0.0F, 10.0F};  ///< a worn path leads from the fire through here
  int seed = 1;
};

/// What stands on the ground. All of it outlives the bake.
struct Standing {
  const world::Triangles& shades;  ///< what stops light
  const world::RayScene& rays;     ///< the same
  const world::RayScene& solids;   ///< of that, what is no foliage
};

/// Bakes the light that reaches the ground from a sun in the direction `sun`, a unit vector, and from the sky: soft
/// shadows of a sun disc, and occlusion of the sky near things' feet. No grass grows under low foliage, which has its
/// own. `progress` gets shares of 0..1.
[[nodiscard]] Clearing bakeClearing(const ClearingOptions& options, world::Vec3 sun, const Standing& standing,
                                    const std::function<void(float)>& progress);

}  // namespace grove::objects::ground
