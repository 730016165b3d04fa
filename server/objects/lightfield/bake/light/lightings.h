#pragma once

#include <vector>

#include "world/sky.h"

namespace grove::bake {

/// The light for a bake: a world's sun and sky, rotated about Y in equal steps, so that the sun of lighting k has
/// azimuth firstAzimuth() + k * 2 pi / count().
class Lightings {
 public:
  Lightings(const world::Sky& sky, int count);

  [[nodiscard]] int count() const noexcept { return static_cast<int>(turns_.size()); }
  /// Azimuth of the world's own sun: atan2(x, z), radians.
  [[nodiscard]] float firstAzimuth() const noexcept;

  /// See the functions of the same names in world::Sky.
  [[nodiscard]] world::Vec3 sunColour() const noexcept { return sky_.sunColour; }
  [[nodiscard]] world::Vec3 sun(int k) const noexcept;
  [[nodiscard]] world::Vec3 skyRadiance(int k, world::Vec3 direction) const noexcept;
  [[nodiscard]] world::Vec3 ambient(int k, world::Vec3 normal) const noexcept;

  /// Radiance of the open meadow that ambient() includes below the horizon, the same for all k, and the albedo that
  /// gives a meadow this radiance under this sun and sky.
  [[nodiscard]] world::Vec3 meadowRadiance() const noexcept;
  [[nodiscard]] world::Vec3 meadowAlbedo() const noexcept;

 private:
  struct Turn {
    float cosine;
    float sine;
  };
  const world::Sky sky_;
  std::vector<Turn> turns_;
};

}  // namespace grove::bake
