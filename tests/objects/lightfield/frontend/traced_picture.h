#pragma once

#include <memory>

#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"
#include "world/rays/ray_scene.h"

namespace grove::objects::lightfield {

/// Something to look at whose every picture can be had by tracing rays.
class TracedModel {
 public:
  explicit TracedModel(const world::Triangles& triangles);

  /// Leaves of two triangles each, `edge` metres long, everywhere in the ball around (0, `radius`, 0).
  static TracedModel crown(float radius, int leaves, float edge);
  /// Thin upright blades, some of them narrower than a pixel of most pictures.
  static TracedModel blades(int count, float width);
  /// A box and a ball on a plate.
  static TracedModel stillLife();

  /// Its ball.
  [[nodiscard]] const ViewGeometry& geometry() const noexcept { return geometry_; }
  /// Distance in lengths of the ray; kInfiniteDepth if it meets nothing.
  [[nodiscard]] float depth(world::Vec3 eye, world::Vec3 ray) const;
  /// The pixels `rect`, each of `samples` x `samples` rays.
  [[nodiscard]] std::shared_ptr<raster::Image> picture(const ObjectCamera& camera, const world::Rect& rect,
                                                       int samples) const;

 private:
  world::RayScene scene_;
  ViewGeometry geometry_;
};

/// A camera at `eye` that looks at `at`, for a frame of this size and focal length in pixels.
[[nodiscard]] ObjectCamera frameCamera(world::Vec3 eye, world::Vec3 at, int width, int height, float focal);

/// Where a frame's camera sees a point: x and y in pixels, z the depth.
[[nodiscard]] world::Vec3 projected(const ObjectCamera& camera, world::Vec3 point);

/// The frame's pixels in which the ball can be.
[[nodiscard]] world::Rect ballRect(const ViewGeometry& geometry, const ObjectCamera& camera, int width, int height);

/// Over grey, in the pixels that at least one of both shows; decibels of 255.
[[nodiscard]] double psnr(const raster::Image& a, const raster::Image& b);

}  // namespace grove::objects::lightfield
