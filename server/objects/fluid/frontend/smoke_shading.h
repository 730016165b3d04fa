#pragma once

#include <array>
#include <span>

#include "objects/fluid/frontend/smoke_detail.h"
#include "objects/fluid/frontend/smoke_shading_kernels.h"
#include "objects/fluid/frontend/smoke_sprites.h"
#include "world/light.h"
#include "world/sky.h"

namespace grove::objects::fluid {

/// Computes the sprites' colour and opacity: smoke scatters the light of sun, sky, fire and lanterns; flames emit their
/// own. Works in linear radiance, then display-encodes through a table. One per session.
class SmokeShading {
 public:
  explicit SmokeShading(const world::Sky& sky);

  /// `time` in seconds drives the flames' flicker.
  void shade(const FluidSnapshot& snapshot, const world::Camera& camera, std::span<const world::PointLight> lights,
             const SmokeDetail& detail, double time, SmokeSprites& sprites) const;

 private:
  const world::Vec3 sun_;
  const world::Vec3 sunColour_;
  const SmokeSky sky_;
  std::array<float, kDisplaySteps + 1> display_{};
};

}  // namespace grove::objects::fluid
