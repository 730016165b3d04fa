#pragma once

#include <cstdint>
#include <vector>

#include "models/model.h"

namespace grove::bake {

/// A texture for rays: repeated, with a mip pyramid in linear colour. Immutable; any thread.
class TextureSampler {
 public:
  explicit TextureSampler(const models::Texture& texture);

  /// Bilinear, linear colour; `texels` is the look-up's footprint in texels of the finest level.
  [[nodiscard]] world::Vec3 colour(world::Vec2 uv, float texels) const noexcept;
  /// Alpha of the nearest texel, 0..1.
  [[nodiscard]] float alpha(world::Vec2 uv) const noexcept;
  /// Mean of the non-transparent texels.
  [[nodiscard]] world::Vec3 mean() const noexcept { return mean_; }
  /// Geometric mean of width and height.
  [[nodiscard]] float size() const noexcept { return size_; }

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<world::Vec4> texels;  ///< colour weighted by A = alpha
  };

  std::vector<Level> levels_;
  world::Vec3 mean_{1.0F};
  float size_ = 1.0F;
};

}  // namespace grove::bake
