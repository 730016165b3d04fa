#pragma once

#include "objects/fluid/frontend/smoke_sprites.h"

namespace grove::objects::fluid {

/// How finely one frame's smoke is drawn. Fill rate is the whole cost of sprites, so the finest detail is taken whose
/// estimated cost stays within a budget.
struct SmokeDetail {
  int scale = 2;      ///< pixels of the frame per pixel of the target, in each direction: 2 or 4
  float kept = 1.0F;  ///< share of the smoke sprites that is drawn, the others' opacity falls to these; flames all stay
};

/// The sprites must have been shaped. `budget` is in blocks of 16 pixels of the target that all sprites together may
/// touch; `before` is the detail of the last frame, which is kept where the choice is close. After Cook, Halstead,
/// Planck and Ryu, "Stochastic Simplification of Aggregate Detail" (2007): leaving out a random share of many
/// overlapping sprites and making the rest denser does not change the mean picture.
[[nodiscard]] SmokeDetail chooseDetail(const world::Camera& camera, const SmokeSprites& sprites, float budget,
                                       const SmokeDetail& before);

}  // namespace grove::objects::fluid
