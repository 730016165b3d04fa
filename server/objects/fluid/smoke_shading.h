#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "objects/fluid/smoke_detail.h"
#include "objects/fluid/smoke_sprites.h"
#include "world/light.h"

namespace grove::objects::fluid {

/// Gives sprites their colour and opacity: sun, sky, fire and lanterns scattered by the smoke, flames by their own
/// light. Computed in linear radiance, then display-encoded through a table. One per session.
class SmokeShading {
 public:
  SmokeShading();

  /// `time` in seconds lets the flames flicker.
  void shade(const FluidSnapshot& snapshot, const world::Camera& camera, std::span<const world::PointLight> lights,
             const SmokeDetail& detail, double time, SmokeSprites& sprites);

 private:
  void scatter(const FluidSnapshot& snapshot, const world::Camera& camera, SmokeSprites& sprites) const;
  void illuminate(const FluidSnapshot& snapshot, const world::PointLight& light, SmokeSprites& sprites) const;
  void finish(const FluidSnapshot& snapshot, const SmokeDetail& detail, float time, SmokeSprites& sprites) const;

  static constexpr std::size_t kSteps = 1024;
  static constexpr float kBrightest = 9.0F;
  /// toDisplay() of the square of its position, so that the dark end, where eyes see steps, has more entries.
  std::array<float, kSteps + 1> display_{};
};

}  // namespace grove::objects::fluid
