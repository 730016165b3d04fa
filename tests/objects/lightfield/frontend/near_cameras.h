#pragma once

#include <cmath>

#include "objects/lightfield/format/view_camera.h"

/// Cameras of square pictures.
namespace grove::objects::lightfield {

inline constexpr int kPictureSize = 96;
inline constexpr float kPictureFocal = 80.0F;

/// Looks along -z, turned to the left by `yaw`; (0, 0) is the frame's first pixel.
inline ObjectCamera turnedCamera(world::Vec3 eye, float yaw = 0.0F) {
  const world::Vec3 right(std::cos(yaw), 0.0F, -std::sin(yaw));
  const world::Vec3 ahead(-std::sin(yaw), 0.0F, -std::cos(yaw));
  ObjectCamera camera;
  camera.eye = eye;
  camera.perColumn = right / kPictureFocal;
  camera.perRow = world::Vec3(0.0F, -1.0F, 0.0F) / kPictureFocal;
  camera.corner = ahead - 0.5F * kPictureSize * (camera.perColumn + camera.perRow);
  return camera;
}

}  // namespace grove::objects::lightfield
