#pragma once

#include <vector>

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

namespace grove::models {

/// A trunk, branch, twig or stalk: a tapered tube along a path.
struct Limb {
  struct Point {
    world::Vec3 position{0.0F};
    float radius = 0.0F;
  };
  std::vector<Point> points;  ///< at least two

  [[nodiscard]] const Point& tip() const { return points.back(); }
  /// Position and radius at a share (0 to 1) of the points.
  [[nodiscard]] Point at(float share) const;
  /// Unit vector along the limb at a share of the points.
  [[nodiscard]] world::Vec3 directionAt(float share) const;
};

/// Parameters of a limb's growth from its root.
struct Growth {
  world::Vec3 root{0.0F};
  world::Vec3 direction{0.0F, 1.0F, 0.0F};  ///< unit
  float length = 1.0F;
  float rootRadius = 0.01F;
  float tipRadius = 0.002F;
  float sag = 0.0F;     ///< downward pull (upward if negative) per metre at the tip; little at the root
  float rise = 0.0F;    ///< upward pull in the last third, per metre
  float wander = 0.1F;  ///< radians of random turn per step
  int steps = 8;
};
[[nodiscard]] Limb grow(const Growth& growth, Random& random);

/// A place on a limb, the input of bark functions.
struct BarkPlace {
  world::Vec3 position{0.0F};  ///< on the smooth tube
  world::Vec3 onLimb{0.0F};    ///< around and along (y) the limb in metres: noise of it has no seam
  world::Vec3 normal{0.0F};    ///< unit
  float radius = 0.0F;
};
struct BarkLook {
  world::Vec3 colour{1.0F};
  float relief = 0.0F;  ///< metres outwards
};
using Bark = BarkLook (*)(const BarkPlace&);

/// Draws a limb as a closed surface. Distant detail has no twigs.
void drawLimb(MeshWriter& mesh, const Limb& limb, Bark bark, std::uint16_t material, Detail detail);

}  // namespace grove::models
