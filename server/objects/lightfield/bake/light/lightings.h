#pragma once

#include <vector>

#include "world/geometry.h"

namespace grove::bake {

/// The light that an object is baked in: the world's sun and sky (world/light.h), turned about Y in equal steps, so
/// that lighting k has its sun at azimuth firstAzimuth() + k * 2 pi / count().
class Lightings {
 public:
  explicit Lightings(int count);

  [[nodiscard]] int count() const noexcept { return static_cast<int>(turns_.size()); }
  /// Of the world's own sun: atan2(x, z), radians.
  [[nodiscard]] static float firstAzimuth() noexcept;

  /// As their namesakes in world/light.h.
  [[nodiscard]] world::Vec3 sunDirection(int k) const noexcept;
  [[nodiscard]] world::Vec3 skyRadiance(int k, world::Vec3 direction) const noexcept;
  [[nodiscard]] world::Vec3 ambient(int k, world::Vec3 normal) const noexcept;

  /// Radiance of the open meadow that world::ambient() sees below the horizon, the same for all k, and the albedo that
  /// a meadow has that looks so under this sun and sky.
  [[nodiscard]] static world::Vec3 meadowRadiance() noexcept;
  [[nodiscard]] static world::Vec3 meadowAlbedo() noexcept;

 private:
  struct Turn {
    float cosine;
    float sine;
  };
  std::vector<Turn> turns_;
};

}  // namespace grove::bake
