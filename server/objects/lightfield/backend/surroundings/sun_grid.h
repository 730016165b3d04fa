#pragma once

#include <array>
#include <vector>

#include "world/geometry.h"
#include "world/object.h"
#include "world/rays/ray_scene.h"

namespace grove::objects::lightfield {

/// The share of the sun that other objects leave to one object, place by place: 1 all, 0 none. The object's light field
/// was baked for the object alone; the grid adds the shade of stones, trunks and other trees. Across-user: made once.
struct SunGrid {
  std::array<int, 3> cells{1, 1, 1};  ///< samples along x, y and z, at least 2 each unless `whole`
  world::Vec3 low{0.0F};              ///< object coordinates of the first sample
  world::Vec3 perMetre{0.0F};         ///< samples per metre
  std::vector<float> sun;             ///< x fastest
  bool whole = true;                  ///< full sun everywhere
};

/// `rays` contains everything that blocks light in the world, including the object; hits within the object's own box
/// are ignored. `towardsSun` is a unit vector.
[[nodiscard]] SunGrid makeSunGrid(const world::ModelledObject& object, world::Vec3 towardsSun,
                                  const world::RayScene& rays);

}  // namespace grove::objects::lightfield
