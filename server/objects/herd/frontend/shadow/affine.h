#pragma once

#include "world/camera.h"

namespace grove::objects::herd {

/// A value that grows evenly in space, in one direction.
struct Affine {
  world::Vec3 slope{0.0F};
  float start = 0.0F;

  [[nodiscard]] float at(world::Vec3 point) const noexcept { return glm::dot(slope, point) + start; }
};

/// The rays through a camera's pixels, each as long as one metre of view depth.
struct PixelRays {
  world::Vec3 eye;
  world::Vec3 right;  ///< from a pixel's ray to that of the next to the right
  world::Vec3 down;
  world::Vec3 first;  ///< of the pixel at the top left

  explicit PixelRays(const world::Camera& camera)
      : eye(camera.pose.position),
        right((camera.ray(static_cast<float>(camera.width), 0.0F) - camera.ray(0.0F, 0.0F)) /
              static_cast<float>(camera.width)),
        down((camera.ray(0.0F, static_cast<float>(camera.height)) - camera.ray(0.0F, 0.0F)) /
             static_cast<float>(camera.height)),
        first(camera.ray(0.5F, 0.5F)) {}

  [[nodiscard]] world::Vec3 of(int x, int y) const noexcept {
    return first + static_cast<float>(x) * right + static_cast<float>(y) * down;
  }
};

/// The same value along a row of pixels: start + depth * (perDepth + column * perColumn), where `depth` is the view
/// depth of what a pixel shows, and `column` counts from the row's first pixel.
struct AffineRow {
  /// `ray`: of the first pixel; `rayStep`: from there to the next pixel's.
  AffineRow(const Affine& value, world::Vec3 eye, world::Vec3 ray, world::Vec3 rayStep) noexcept
      : start(value.at(eye)), perDepth(glm::dot(value.slope, ray)), perColumn(glm::dot(value.slope, rayStep)) {}

  float start;
  float perDepth;
  float perColumn;
};

}  // namespace grove::objects::herd
