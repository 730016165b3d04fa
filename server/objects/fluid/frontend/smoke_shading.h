#pragma once

#include <array>
#include <span>

#include "objects/fluid/frontend/smoke_detail.h"
#include "objects/fluid/frontend/smoke_shading_kernels.h"
#include "objects/fluid/frontend/smoke_sprites.h"
#include "world/light.h"
#include "world/sky.h"

namespace grove::objects::fluid {

/// Gives sprites their colour and opacity: sun, sky, fire and lanterns scattered by the smoke, flames by their own
/// light. Computed in linear radiance, then display-encoded through a table. One per session.
class SmokeShading {
 public:
  explicit SmokeShading(const world::Sky& sky);

  /// `time` in seconds lets the flames flicker.
  void shade(const FluidSnapshot& snapshot, const world::Camera& camera, std::span<const world::PointLight> lights,
             const SmokeDetail& detail, double time, SmokeSprites& sprites) const;

 private:
  const world::Vec3 sun_;
  const world::Vec3 sunColour_;
  const world::Vec3 sky_;
  std::array<float, kDisplaySteps + 1> display_{};
};

}  // namespace grove::objects::fluid
