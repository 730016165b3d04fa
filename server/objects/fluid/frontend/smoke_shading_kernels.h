#pragma once

#include <cstddef>

#include "objects/fluid/frontend/smoke_sprites.h"
#include "world/light.h"

/// Kernels of SmokeShading over all sprites.
namespace grove::objects::fluid {

/// A table of toDisplay(): entry i is the value at kBrightestSmoke * (i / kDisplaySteps)^2. The dark end, where eyes
/// see steps, has more entries.
inline constexpr std::size_t kDisplaySteps = 1024;
inline constexpr float kBrightestSmoke = 9.0F;

/// Radiance of smoke that is white and lit by the sky alone. Smoke above it hides the part from above; that from the
/// side comes from where the eye is, so it reaches all smoke that the eye sees.
struct SmokeSky {
  world::Vec3 above, side;
};

/// Sets each sprite's colour to the linear radiance of the sun (`sun` is the unit vector towards it) and the sky that
/// the smoke scatters towards `eye`.
void scatterSunAndSky(const FluidSnapshot& snapshot, world::Vec3 eye, world::Vec3 sun, world::Vec3 sunColour,
                      const SmokeSky& sky, SmokeSprites& sprites);

/// Adds the scattered light of a fire or a lantern.
void addPointLight(const FluidSnapshot& snapshot, const world::PointLight& light, SmokeSprites& sprites);

/// Adds the flames' own light at `time` seconds, encodes colours through the table `display`, and sets opacity and
/// softness. `kept` is SmokeDetail::kept.
void finishSprites(const FluidSnapshot& snapshot, float kept, float time, const float* display, SmokeSprites& sprites);

}  // namespace grove::objects::fluid
