#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "objects/ground/common/clearing.h"
#include "world/geometry.h"
#include "world/ground/hills.h"
#include "world/rays/ray_scene.h"

namespace grove::objects::ground {

struct ClearingOptions {
  int size = 2048;                        ///< texels per side, a power of two
  float metres = 160.0F;                  ///< side of the square
  float hearth = 2.6F;                    ///< radius of the trodden earth around the fire at the origin, metres
  world::Vec3 pathTo{0.0F, 0.0F, 10.0F};  ///< a worn path leads from the fire through this point
  int seed = 1;
  std::vector<world::Hill> hills = {};  ///< that the ground is made of
  /// Metres from the origin up to which the ground is baked in detail; beyond, nobody comes near it.
  float detailed = std::numeric_limits<float>::infinity();
};

/// Calls `work` once for each number below `rows`, in any order and on any threads, and returns after that. The label
/// says what is done.
using ForEachRow =
    std::function<void(std::string_view label, std::size_t rows, const std::function<void(std::size_t)>& work)>;

/// The objects on the ground. All members outlive the bake.
struct Standing {
  std::span<const world::PlacedTriangles> shades;  ///< everything that blocks light
  const world::RayScene& rays;                     ///< the same as a ray scene
  const world::RayScene& solids;                   ///< the same without foliage
};

/// Bakes the light on the ground from the sky and from a sun in the direction `sun`, a unit vector: soft shadows of a
/// sun disc, and sky occlusion near objects. No grass grows under low foliage, which covers the ground itself.
[[nodiscard]] Clearing bakeClearing(const ClearingOptions& options, world::Vec3 sun, const Standing& standing,
                                    const ForEachRow& forEachRow);

}  // namespace grove::objects::ground
