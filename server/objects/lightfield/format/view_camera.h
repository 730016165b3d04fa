#pragma once

#include "world/geometry.h"

namespace grove::objects::lightfield {

/// Object coordinates, metres. Views lie on the upper half of the sphere around `centre` (on the ground). Each frames
/// the ball around `target` that encloses the object, so that views use their texels well.
struct ViewGeometry {
  world::Vec3 centre{0.0F};
  float radius = 2.0F;
  world::Vec3 target{0.0F};
  float extent = 1.0F;  ///< radius of the enclosing ball
};

/// Whether every view's camera is outside the ball that it frames.
[[nodiscard]] bool seesItsBall(const ViewGeometry& geometry) noexcept;

/// The pinhole camera of one view.
struct ViewCamera {
  world::Vec3 eye{0.0F};
  world::Vec3 right{1.0F, 0.0F, 0.0F};
  world::Vec3 down{0.0F, 0.0F, 1.0F};
  world::Vec3 forward{0.0F, -1.0F, 0.0F};
  float focal = 1.0F;      ///< in image heights: x = 0.5 + focal * dot(right, p) / dot(forward, p), from 0 to 1
  float nearDepth = 0.0F;  ///< view depths that enclose everything
  float farDepth = 1.0F;
};

/// The camera in `direction` (unit vector from the centre).
[[nodiscard]] ViewCamera viewCamera(const ViewGeometry& geometry, world::Vec3 direction) noexcept;

/// Any camera in object coordinates: a pixel's ray is `corner + x * perColumn + y * perRow` (pixel centres at +0.5),
/// and its points are `eye + depth * ray`; depth is the world's view depth in metres even if the object is scaled.
struct ObjectCamera {
  world::Vec3 eye{0.0F};
  world::Vec3 corner{0.0F};
  world::Vec3 perColumn{0.0F};
  world::Vec3 perRow{0.0F};

  [[nodiscard]] world::Vec3 ray(float x, float y) const noexcept { return corner + x * perColumn + y * perRow; }
};

/// A view's camera as an ObjectCamera for an image of size x size pixels.
[[nodiscard]] ObjectCamera objectCamera(const ViewCamera& camera, int size) noexcept;

}  // namespace grove::objects::lightfield
