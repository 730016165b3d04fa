#pragma once

#include <array>
#include <cstdint>

#include "objects/herd/frontend/shadow/affine.h"
#include "objects/herd/frontend/shadow/contact.h"
#include "objects/herd/frontend/shadow/screen_hull.h"
#include "objects/herd/frontend/shadow/shadow_mask.h"
#include "raster/image.h"
#include "world/sky.h"

namespace grove::objects::herd {

/// The shadows of one animal in one frame: that of the sun, and the dimness between its body and the ground. They fall
/// on the plane through its feet, and on what is a little above it, such as grass.
class DeerShadow {
 public:
  /// Metres from the eye beyond which none is drawn.
  static constexpr float kFarthest = 45.0F;

  /// `casters` are those of the pose; `sunShare`: of the sun that reaches the animal, 0..1; `frame`: pixels of the
  /// camera's image that may be darkened.
  DeerShadow(const AnimalPose& pose, float size, const Capsules& casters, float sunShare, const world::Sky& sky,
             const world::Camera& camera, const world::Rect& frame);

  /// Contains all pixels that draw() darkens or reads.
  [[nodiscard]] const world::Rect& rect() const noexcept { return hull_.rect(); }

  /// Darkens the ground in a frame. Keeps alpha. `body`: the animal's own picture, which stays as it is; null if it has
  /// none.
  void draw(const world::Camera& camera, const raster::Image* body, raster::Image& frame) const;

 private:
  Ground ground_;
  world::Vec3 place_;
  world::Vec2 away_;  ///< horizontal unit vector from the sun
  float sunStrength_;
  Contact contact_;
  ScreenHull hull_;
  SunMask mask_;
};

}  // namespace grove::objects::herd
