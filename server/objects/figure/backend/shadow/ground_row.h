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

  /// `row` is a place in the camera's image, not only the middle of a pixel; `ground` is the height of the ground.
  [[nodiscard]] static std::optional<GroundRow> at(float row, float ground, const world::Camera& camera) {
    const world::Vec3 ray = camera.ray(0.0F, row);
    const float height = camera.pose.position.y - ground - world::kShadowPlane;
    if (height <= 0.0F) return std::nullopt;
    const float depth = -height / ray.y;
    if (!(depth > camera.nearDepth) || depth > camera.farDepth) return std::nullopt;
    const float above = std::max(0.0F, height - kBladesAbove);
    const float front = std::max({camera.nearDepth, above / height * depth, depth - kDeepestBlades});
    return GroundRow{depth, front, camera.pose.position + depth * ray, depth / camera.focal() * camera.pose.right(),
                     depth * depth / (camera.focal() * height)};
  }
};

}  // namespace grove::objects::figure
