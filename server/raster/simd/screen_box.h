#pragma once

#include <span>

#include "raster/surface.h"
#include "world/camera.h"

namespace grove::raster {

/// All points of a surface in the layout that the vectorised search below wants.
struct PointCloud {
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> z;

  explicit PointCloud(const Surface& surface);

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(x, y, z); }
};

/// Smallest rectangle of pixels that holds the points, within `most`, which is returned if one of them is not before
/// the camera. Much tighter than the box of a leaning or turned object, and every pixel less is one less to clear and
/// copy.
[[nodiscard]] world::Rect screenBox(const PointCloud& points, const world::Mat4& toWorld, const world::Camera& camera,
                                    const world::Rect& max);

}  // namespace grove::raster
