#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "raster/tube.h"

/// Colours of fallow deer, and the curves that their bodies are drawn with.
namespace grove::objects::herd {

// Linear albedo.
inline const world::Vec3 kChestnut{0.185F, 0.098F, 0.050F};
inline const world::Vec3 kDarkCoat{0.088F, 0.052F, 0.032F};
inline const world::Vec3 kPaleCoat{0.44F, 0.36F, 0.265F};
inline const world::Vec3 kWhiteCoat{0.66F, 0.61F, 0.53F};
inline const world::Vec3 kBlackCoat{0.020F, 0.016F, 0.014F};
inline const world::Vec3 kHorn{0.20F, 0.15F, 0.10F};

/// A cubic curve through knots; unlike raster::profile(), without a flat place at each of them. `knots` are sorted, at
/// least two.
[[nodiscard]] inline float curve(std::span<const raster::Knot> knots, float along) {
  const auto after = std::ranges::find_if(knots, [&](const raster::Knot& knot) { return knot.along > along; });
  if (after == knots.begin()) return knots.front().value;
  if (after == knots.end()) return knots.back().value;
  const auto before = std::prev(after);
  const float length = after->along - before->along;
  const auto slopeAt = [&](auto knot) {
    const auto left = knot == knots.begin() ? knot : std::prev(knot);
    const auto right = std::next(knot) == knots.end() ? knot : std::next(knot);
    return (right->value - left->value) / (right->along - left->along);
  };
  const float t = (along - before->along) / length;
  const float rest = 1.0F - t;
  return rest * rest * ((1.0F + 2.0F * t) * before->value + t * length * slopeAt(before)) +
         t * t * ((3.0F - 2.0F * t) * after->value - rest * length * slopeAt(after));
}

/// Factor of a tube's radius that rounds its ends. `low` and `high`: shares of the length that they take.
[[nodiscard]] inline float rounded(float along, float low, float high) {
  const float inside = std::min({1.0F, along / low, (1.0F - along) / high});
  const float off = 1.0F - inside;
  return std::max(0.12F, std::sqrt(std::max(0.0F, 1.0F - off * off)));
}

/// 1 inside, 0 outside, between them a soft edge.
[[nodiscard]] inline float within(float value, float inside, float outside) {
  return inside < outside ? 1.0F - glm::smoothstep(inside, outside, value) : glm::smoothstep(outside, inside, value);
}

/// How the kinds differ. Lengths are those of a doe: the animal's size scales all of it.
struct Build {
  float neck = 1.0F;   ///< thickness, relative to a doe's
  float trunk = 1.0F;  ///< the same
  float legs = 1.0F;   ///< the same
  float head = 1.0F;   ///< size
  float spots = 1.0F;  ///< how bright they are
  bool antlers = false;
};

}  // namespace grove::objects::herd
