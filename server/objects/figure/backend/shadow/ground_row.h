#pragma once

#include <algorithm>
#include <optional>

#include "world/camera.h"
#include "world/ground/ground_shadow.h"

namespace grove::objects::figure {

/// Grass that the shadow falls on reaches so far above the plane that shows it. Metres.
inline constexpr float kBladesAbove = 0.2F;
/// Limits how far before that plane a shadow covers what it falls on, at grazing angles. Metres of depth.
inline constexpr float kDeepestBlades = 1.5F;

/// A row of pixels where it meets the plane that shows shadows. The camera does not roll, so that depth is constant
/// along the row, and the points of its pixels lie on a line at equal distances.
struct GroundRow {
  float depth;        ///< metres
  float front;        ///< depth where the tallest blades of grass may begin, which the shadow falls on, too
  world::Vec3 first;  ///< the point at the left end of column 0
  world::Vec3 step;   ///< from one column to the next
  float length;       ///< metres of ground that the row covers
};

/// The rows of a camera's image on level ground.
class GroundRows {
 public:
  /// `ground` is the height of the ground.
  GroundRows(float ground, const world::Camera& camera) noexcept
      : camera_(camera),
        height_(camera.pose.position.y - ground - world::kShadowPlane),
        focal_(camera.focal()),
        left_(camera.pose.forward() - camera.tanHalfX() * camera.pose.right()),
        up_(camera.tanHalfY() * camera.pose.up()),
        across_(camera.pose.right()) {}

  /// `row` is a place in the image, not only the middle of a pixel.
  [[nodiscard]] std::optional<GroundRow> at(float row) const noexcept {
    if (height_ <= 0.0F) return std::nullopt;
    const world::Vec3 ray = left_ + (1.0F - 2.0F * row / static_cast<float>(camera_.height)) * up_;
    const float depth = -height_ / ray.y;
    if (!(depth > camera_.nearDepth) || depth > camera_.farDepth) return std::nullopt;
    const float above = std::max(0.0F, height_ - kBladesAbove);
    const float front = std::max({camera_.nearDepth, above / height_ * depth, depth - kDeepestBlades});
    return GroundRow{depth, front, camera_.pose.position + depth * ray, depth / focal_ * across_,
                     depth * depth / (focal_ * height_)};
  }

 private:
  const world::Camera& camera_;
  const float height_;  ///< of the eye above the plane that shows shadows
  const float focal_;
  const world::Vec3 left_;  ///< the ray through the left end of the middle row
  const world::Vec3 up_;    ///< from there to the left end of the top
  const world::Vec3 across_;
};

}  // namespace grove::objects::figure
