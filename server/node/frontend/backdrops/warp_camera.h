#pragma once

#include "world/camera.h"

namespace grove::node {

/// Rays that advance less along the backdrop's view direction meet nothing in it.
inline constexpr float kMinForward = 1.0e-3F;

/// Maps pixels of a frame to pixels of a backdrop that was drawn from another eye.
///
/// A point of the backdrop at pixel s with nearness w = 1 / depth is c + (C s) / w, for the eye c of the backdrop's
/// camera and the matrix C of its rays; a ray of the frame is e + t r. With k = inverse(C) r and m = inverse(C) (e -
/// c), they meet where s = a + b w, for a = (k0, k1) / k2, b = (m0, m1) - a m2, and then t = (1 / w - m2) / k2.
struct WarpCamera {
  world::Vec3 k, kPerColumn, kPerRow;  ///< k of the frame's pixel (0, 0), and its change per column and row
  world::Vec3 m;

  WarpCamera(const world::Camera& backdrop, const world::Camera& frame);

  /// k of a point of the frame.
  [[nodiscard]] world::Vec3 at(float x, float y) const { return k + x * kPerColumn + y * kPerRow; }
  /// The b of an a: pixels of the backdrop per unit of nearness.
  [[nodiscard]] world::Vec2 shiftPerNearness(world::Vec2 a) const { return world::Vec2(m) - a * m.z; }
};

}  // namespace grove::node
