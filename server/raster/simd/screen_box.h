#pragma once

#include <span>

#include "raster/surface.h"
#include "world/camera.h"

namespace grove::raster {

/// All points of a surface in the layout of the vectorised search below.
struct PointCloud {
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> z;

  explicit PointCloud(const Surface& surface);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(x, y, z); }
};

/// The smallest rectangle of pixels around the points, within `max`; returns `max` if a point is not in front of the
/// camera. Much tighter than the projected bounding box of a leaning or rotated object, which saves clearing and
/// copying pixels.
[[nodiscard]] world::Rect screenBox(const PointCloud& points, const world::Mat4& toWorld, const world::Camera& camera,
                                    const world::Rect& max);

}  // namespace grove::raster
