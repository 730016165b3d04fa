#pragma once

#include "objects/fluid/frontend/smoke_target_kernels.h"
#include "world/camera.h"
#include "world/geometry.h"

/// Carves curls into smoke on its target. Sprites are smooth, and a column of thousands of them is a smooth pillar; its
/// detail is a noise that moves with the smoke.
namespace grove::objects::fluid {

/// The noise's octaves, coarsest first, in periods per metre. All of them repeat after kCurlRepeat metres.
inline constexpr int kCurlOctaves = 4;
inline constexpr float kCurlPeriods[kCurlOctaves] = {1.25F, 2.75F, 6.0F, 13.0F};
inline constexpr double kCurlRepeat = 64.0;

/// Speed of the noise, metres per second: that of smoke above a camp fire.
inline constexpr float kCurlPace = 1.8F;

/// Share of the smoke's own age in the noise's height: smoke that is slower than its surroundings drags the noise
/// along. More of it stretches the noise into strings.
inline constexpr float kCurlDrag = 0.15F;

/// Smoke below this age, in seconds, is flame.
inline constexpr float kFlameSeconds = 0.7F;

/// One frame's view of a target's pixels.
struct CurlLens {
  /// `seconds` is the time that the smoke shows, `sun` the unit vector towards the sun.
  CurlLens(const world::Camera& camera, const SmokePixels& pixels, double seconds, world::Vec3 sun);

  world::Vec3 eye;
  world::Vec3 corner, right, down;  ///< ray through the target's first pixel; steps to the next column and row
  float finest;                     ///< width of the finest visible detail at a depth of one metre, metres
  float risen;                      ///< way of the noise since the world's beginning, metres below kCurlRepeat
  world::Vec3 sun;
};

/// Changes colour and `clear` of all touched pixels. Each octave of the noise fades out where it is too fine to see: in
/// the distance, and where the smoke's age changes fast.
void carveCurls(const CurlLens& lens, const SmokePixels& pixels);

}  // namespace grove::objects::fluid
