#pragma once

#include <vector>

#include "world/sky.h"

namespace grove::bake {

/// The light that an object is baked in: a world's sun and sky, turned about Y in equal steps, so that lighting k has
/// its sun at azimuth firstAzimuth() + k * 2 pi / count().
class Lightings {
 public:
  Lightings(const world::Sky& sky, int count);

  [[nodiscard]] int count() const noexcept { return static_cast<int>(turns_.size()); }
  /// Of the world's own sun: atan2(x, z), radians.
  [[nodiscard]] float firstAzimuth() const noexcept;

  /// As their namesakes of world::Sky.
  [[nodiscard]] world::Vec3 sunColour() const noexcept { return sky_.sunColour; }
  [[nodiscard]] world::Vec3 sun(int k) const noexcept;
  [[nodiscard]] world::Vec3 skyRadiance(int k, world::Vec3 direction) const noexcept;
  [[nodiscard]] world::Vec3 ambient(int k, world::Vec3 normal) const noexcept;

  /// Radiance of the open meadow that ambient() sees below the horizon, the same for all k, and the albedo that
  /// a meadow has that looks so under this sun and sky.
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
