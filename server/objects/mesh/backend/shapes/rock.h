#pragma once

#include <cstdint>

#include "raster/surface.h"

namespace grove::objects::mesh {

/// Parameters of a rock.
struct RockForm {
  world::Vec3 half{0.5F};  ///< metres, half extents
  float roundness = 5.0F;  ///< exponent of the superellipsoid: 2 an egg, large a box
  float taper = 0.0F;      ///< share of the width lost from foot to top
  float lean = 0.0F;       ///< metres, sideways offset of the top
  float shoulder = 0.0F;   ///< metres by which one side of the top is higher
  float breaks = 0.8F;     ///< depth of the fracture planes
  float roughness = 1.0F;  ///< scale of the weathered relief
  float buried = 0.0F;     ///< metres below ground; soil and moss begin above
  std::uint32_t seed = 1;
};

/// Makes a rock around the origin from triangles of about `cell` / 2^halvings metres.
[[nodiscard]] raster::Surface makeRock(const RockForm& form, float cell, int halvings);

}  // namespace grove::objects::mesh
