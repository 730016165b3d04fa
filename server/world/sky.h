#pragma once

#include "world/geometry.h"

namespace grove::world {

/// The environment of a whole world: a low sun in a soft evening sky, and haze. Part of the world's layout. Radiance is
/// linear and relative (a white surface in full sun has about 1.8).
///
/// ambient() and hazeColour() have vectorised copies in raster/shading/vertex_light_kernels.cpp, whose test compares
/// them.
struct Sky {
  Vec3 sun = glm::normalize(Vec3(-0.46F, 0.185F, -0.87F));  ///< unit vector towards it
  Vec3 sunColour{1.90F, 1.12F, 0.54F};  ///< reflection of a white diffuse surface that faces the sun

  Vec3 zenith{0.13F, 0.21F, 0.40F};  ///< the sky's radiance overhead
  Vec3 haze{0.44F, 0.385F, 0.41F};   ///< at the horizon away from the sun
  Vec3 glow{1.55F, 0.80F, 0.30F};    ///< of the air in front of the sun

  Vec3 ambientSky{0.25F, 0.32F, 0.46F};     ///< reflection of a white upward surface under the open sky
  Vec3 ambientGround{0.13F, 0.10F, 0.06F};  ///< reflection of a white downward surface above the ground
  Vec3 ambientGlow{0.24F, 0.15F, 0.07F};    ///< addition for a white surface that faces the horizon below the sun

  /// Radiance of the sky (without sun disc, clouds or landscape) in a unit direction; hazeColour() at the horizon and
  /// below.
  [[nodiscard]] Vec3 radiance(Vec3 direction) const noexcept;

  /// Radiance that a white diffuse surface with this unit normal reflects of the unobstructed sky and the ground's
  /// bounce.
  [[nodiscard]] Vec3 ambient(Vec3 normal) const noexcept;

  /// Colour of the air's contribution: result = colour * (1 - amount) + hazeColour * amount, see hazeAmount(). The
  /// direction is a unit vector from the eye.
  [[nodiscard]] Vec3 hazeColour(Vec3 direction) const noexcept;
};

}  // namespace grove::world
