#include "objects/fluid/backend/simulation/particle_obstacles.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {

bool pushOut(const SolidGrid& solids, world::Vec3& at) {
  constexpr int kReach = 2;
  constexpr float kInside = 0.02F;  // distance from the wall, as a share of a cell
  const world::Vec3 own = glm::floor(at);
  float nearest = 1.0e9F;
  world::Vec3 best = at;
  for (int dz = -kReach; dz <= kReach; ++dz) {
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const world::Vec3 cell =
            own + world::Vec3(static_cast<float>(dx), static_cast<float>(dy), static_cast<float>(dz));
        if (!inside(solids.layout(), cell) || !inAir(solids, cell)) continue;
        const world::Vec3 place = glm::clamp(at, cell + kInside, cell + (1.0F - kInside));
        const world::Vec3 way = place - at;
        const float squared = glm::dot(way, way);
        if (squared < nearest) {
          nearest = squared;
          best = place;
        }
      }
    }
  }
  at = best;
  return nearest < 1.0e9F;
}

world::Vec3 travel(const SolidGrid& solids, world::Vec3 from, world::Vec3 way) {
  constexpr int kMaxPieces = 16;
  const float longest = std::max({std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)});
  const int pieces = std::clamp(static_cast<int>(std::ceil(longest / kLongestPiece)), 1, kMaxPieces);
  const world::Vec3 piece = way / static_cast<float>(pieces);
  world::Vec3 at = from;
  for (int i = 0; i < pieces; ++i) {
    const world::Vec3 next = at + piece;
    if (!inside(solids.layout(), next)) return next;
    if (inAir(solids, next)) {
      at = next;
      continue;
    }
    for (int a = 0; a < 3; ++a) {
      world::Vec3 slide = at;
      slide[a] = next[a];
      if (inAir(solids, slide)) at = slide;
    }
  }
  return at;
}

}  // namespace grove::objects::fluid
