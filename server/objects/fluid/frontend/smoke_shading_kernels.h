#pragma once

#include <cstddef>

#include "objects/fluid/frontend/smoke_sprites.h"
#include "world/light.h"

/// The loops of SmokeShading over all sprites.
namespace grove::objects::fluid {

/// A table of toDisplay(): entry i is that of kBrightestSmoke * (i / kDisplaySteps)^2, so that the dark end, where eyes
/// see steps, has more entries.
inline constexpr std::size_t kDisplaySteps = 1024;
inline constexpr float kBrightestSmoke = 9.0F;

/// Sets each sprite's colour to the linear radiance that the smoke scatters towards `eye`, of the sun (`sun` is the
/// unit vector towards it) and of the sky.
void scatterSunAndSky(const FluidSnapshot& snapshot, world::Vec3 eye, world::Vec3 sun, world::Vec3 sunColour,
                      world::Vec3 sky, SmokeSprites& sprites);

/// Adds what it scatters of a fire's or a lantern's light.
void addPointLight(const FluidSnapshot& snapshot, const world::PointLight& light, SmokeSprites& sprites);

/// Adds the flames' own light at `time` seconds, encodes colours by means of the table `display`, and sets opacity and
/// softness. `kept` is SmokeDetail::kept.
void finishSprites(const FluidSnapshot& snapshot, float kept, float time, const float* display, SmokeSprites& sprites);

}  // namespace grove::objects::fluid
