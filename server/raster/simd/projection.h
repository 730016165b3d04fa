#pragma once

#include "world/camera.h"

namespace grove::raster {

/// Projects a point (x, y, z, 1) of an object to the screen by dot products.
struct Projection {
  /// `toWorld` transforms the object's points.
  Projection(const world::Camera& camera, const world::Mat4& toWorld);

  world::Vec4 u;      ///< pixels from the left, times depth
  world::Vec4 v;      ///< pixels from the top, times depth
  world::Vec4 depth;  ///< view depth, metres
};

}  // namespace grove::raster
