#pragma once

#include "models/plants/mesh_writer.h"

namespace grove::models {

/// The outline of a blade seen from above.
enum class Outline { kGrass, kOval, kOak, kBirch, kFern, kPetal };

/// A leaf, petal or blade of grass: a strip along a spine that bends, folded along the spine.
struct Blade {
  world::Vec3 root{0.0F};
  world::Vec3 along{0.0F, 1.0F, 0.0F};  ///< unit; direction at the root
  world::Vec3 face{0.0F, 0.0F, 1.0F};   ///< approximate direction of the upper side
  float length = 0.1F;
  float width = 0.05F;  ///< at the widest point
  float bend = 0.0F;    ///< radians that the spine turns from root to tip, away from `face`
  float fold = 0.2F;    ///< rise of the rims towards `face`, as a share of half the width
  Outline outline = Outline::kOval;
  world::Vec3 rootColour{1.0F};
  world::Vec3 tipColour{1.0F};
  std::uint16_t material = 0;
};

/// Draws a blade as a surface of 4 * (rows - 1) triangles, or of two triangles without a fold for one row. Asserts
/// rows >= 1.
void drawBlade(MeshWriter& mesh, const Blade& blade, int rows);

}  // namespace grove::models
