#pragma once

#include <array>
#include <vector>

#include "world/geometry.h"
#include "world/object.h"
#include "world/rays/ray_scene.h"

namespace grove::objects::lightfield {

/// How much of the sun the rest of the world leaves to one object, place by place: 1 all, 0 none. The light of a light
/// field was baked for the object alone; this is what stones, trunks and other trees take away. Across-user: made once.
struct SunGrid {
  std::array<int, 3> cells{1, 1, 1};  ///< samples along x, y and z, at least 2 each unless `whole`
  world::Vec3 low{0.0F};              ///< object coordinates of the first sample
  world::Vec3 perMetre{0.0F};         ///< samples a metre
  std::vector<float> sun;             ///< x fastest
  bool whole = true;                  ///< all of the sun everywhere
};

/// `rays` is what stops light in the world, the object itself too: what lies within its own box is left out.
/// `towardsSun` is a unit vector.
[[nodiscard]] SunGrid makeSunGrid(const world::ModelledObject& object, world::Vec3 towardsSun,
                                  const world::RayScene& rays);

}  // namespace grove::objects::lightfield
