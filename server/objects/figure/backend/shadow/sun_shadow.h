#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "objects/figure/backend/shadow/ground_row.h"
#include "objects/figure/backend/shadow/ground_sun.h"
#include "objects/figure/backend/shadow/row_shade.h"
#include "objects/figure/backend/shadow/shadow_grid.h"
#include "objects/figure/backend/shadow/shadow_mask.h"
#include "world/sky.h"

namespace grove::objects::figure {

/// The shadow of the sun that one figure casts on the ground, as one camera sees it.
class SunShadow {
 public:
  /// Metres from the eye beyond which nobody sees it.
  static constexpr float kFarthest = 48.0F;
  /// Of the sun's height: nothing casts shadows in the light of a lower sun.
  static constexpr float kLowestSun = 0.05F;

  /// `mask` is that of a figure at `place`, seen from the sun as in `view`. `camera` outlives this.
  SunShadow(world::Vec3 place, const ShadowMask& mask, const SunView& view, const GroundSun& ground,
            const world::Sky& sky, const world::Camera& camera);

  /// Adds it to a row of a picture: its part with this weight.
  void add(const GroundRow& row, float weight, RowShade& shade) const;

  /// Of the shaded ground where it is opaque, displayed, 0..1: not black, as the sky still lights it.
  [[nodiscard]] world::Vec3 colour() const noexcept { return colour_; }

  /// Boxes that enclose it, from the figure's feet outwards.
  static constexpr std::size_t kPieces = 4;
  [[nodiscard]] std::array<world::Bounds, kPieces> pieces() const;

 private:
  /// The point of the ground at a place of the mask.
  [[nodiscard]] world::Vec3 onGround(world::Vec2 place) const;
  [[nodiscard]] std::array<float, kShadowRows> strengths(const ShadowMask& mask, const GroundSun& ground,
                                                         const world::Sky& sky) const;
  /// Share of its colour that a point of the ground has from the sun, in red.
  [[nodiscard]] float darkestAt(world::Vec3 point, const world::Sky& sky) const;

  const world::Vec3 place_;
  const SunView view_;
  const world::Camera& camera_;
  const world::Vec2 low_;  ///< where it begins, in the mask
  const world::Vec2 high_;
  const world::Vec2 perMetre_;  ///< texels of the mask
  const world::Vec3 colour_;
  std::vector<std::uint16_t> texels_;  ///< of the mask, times what each place has of the sun; 65535: 1
};

}  // namespace grove::objects::figure
