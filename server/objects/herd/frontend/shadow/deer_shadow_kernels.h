#pragma once

#include <cstdint>

#include "objects/herd/frontend/shadow/affine.h"
#include "objects/herd/frontend/shadow/contact.h"

namespace grove::objects::herd {

// Metres above the ground: shadows fall on grass, and fade where it ends. The ground may bend away from the plane with
// the distance from the animal.
inline constexpr float kLowestShade = -0.14F;
inline constexpr float kShadeFadesFrom = 0.14F;
inline constexpr float kShadeFadesTo = 0.34F;
inline constexpr float kGroundBend = 0.025F;  // per metre
/// Above that, the animal's own pixels stay as they are.
inline constexpr float kOwnHeight = 0.05F;
/// A pixel shows the animal's own body if its depth differs from the body's by at most this share.
inline constexpr float kSameDepth = 0.002F;

/// Of red, green and blue as they are displayed, in the sun's full shadow; what remains is the sky's light.
inline constexpr world::Vec3 kSunStrength(0.56F, 0.48F, 0.36F);
/// Share of world::kLongestShadow after which the sun's shadow fades.
inline constexpr float kSunFadesAfter = 0.6F;

/// What darkens the ground around one animal.
struct GroundShade {
  const std::uint32_t* texels;  ///< of SunMask
  float sunStrength;            ///< 0..1
  world::Vec2 away;             ///< horizontal unit vector from the sun
  const Contact& contact;
};

/// A row of pixels of a frame.
struct ShadeRow {
  // Of what a pixel shows: metres above the ground, place in the mask, and horizontal place relative to the animal's.
  AffineRow height;
  AffineRow column;
  AffineRow line;
  AffineRow x;
  AffineRow z;
  const float* depths;
  std::uint32_t* colours;
  int count;
  // The columns of the animal's own picture, with the depths there.
  const float* bodyDepths = nullptr;
  int bodyBegin = 0;
  int bodyEnd = 0;
};

/// Kernel: darkens the pixels of a row that show ground within a shade. Keeps alpha, and the animal itself.
void shadeGround(const GroundShade& shade, const ShadeRow& row);

}  // namespace grove::objects::herd
