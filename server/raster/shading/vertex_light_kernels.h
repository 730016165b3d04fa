#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raster/vertex_arrays.h"

namespace grove::raster {

/// One frame's light in the coordinates of one bone, so that vertices need no transform. Directions are unit vectors.
struct BoneLight {
  float metre = 1.0F;  ///< metres per unit of the bone's coordinates
  world::Vec3 eye{0.0F};

  world::Vec3 sun{0.0F};
  world::Vec3 sunColour{0.0F};
  float sunShare = 1.0F;  ///< scales the sun's share of all vertices

  /// Whether the vertices' indirect light is complete; if not, it is a share of the ambient light, `ambient` + `slope`
  /// (normal . `up`) + `glow` (1/2 + normal . `towardsGlow` / 2)^2.
  bool baked = true;
  world::Vec3 up{0.0F};
  world::Vec3 towardsGlow{0.0F};
  world::Vec3 ambient{0.0F};
  world::Vec3 slope{0.0F};
  world::Vec3 glow{0.0F};

  float gloss = 0.0F;  ///< of the surface, see Surface

  int lampCount = 0;
  std::array<world::Vec3, kMaxLamps> lampPosition{};
  std::array<world::Vec3, kMaxLamps> lampColour{};

  float clearing = 0.0F;         ///< logarithm of the transmittance of one unit of air
  world::Vec3 haze{0.0F};        ///< Sky::hazeColour() away from the sun
  world::Vec3 hazeGlow{0.0F};    ///< its increase towards the sun, per unit of 0.36 cos^4 + 0.30 cos^16
  world::Vec3 tintChange{0.0F};  ///< the drawing's tint - 1
};

/// lightVertices() for the vertices from `begin` to before `end`, which follow the light's bone. `out` holds all
/// vertices.
void lightRun(const VertexArrays& arrays, std::size_t begin, std::size_t end, const BoneLight& light,
              std::uint32_t* out);

}  // namespace grove::raster
