#pragma once

#include "objects/fluid/frontend/smoke_sprites.h"

namespace grove::objects::fluid {

/// The detail of one frame's smoke. Fill rate dominates the cost of sprites, so the finest detail with an estimated
/// cost within the budget is used.
struct SmokeDetail {
  int scale = 2;  ///< pixels of the frame per pixel of the target, in each direction: 2 or 4
  /// share of the smoke sprites that is drawn, with higher opacity to compensate; flames are all drawn
  float kept = 1.0F;
};

/// Call after shape(). `budget` is in blocks of 16 target pixels that all sprites together may touch. `before` is the
/// last frame's detail and is kept if the choice is close. After Cook, Halstead, Planck and Ryu, "Stochastic
/// Simplification of Aggregate Detail" (2007): dropping a random share of many overlapping sprites and making the rest
/// denser preserves the mean picture.
[[nodiscard]] SmokeDetail chooseDetail(const world::Camera& camera, const SmokeSprites& sprites, float budget,
                                       const SmokeDetail& before);

}  // namespace grove::objects::fluid
