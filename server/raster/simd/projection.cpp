#include "raster/simd/projection.h"

namespace grove::raster {

using world::Vec3;

Projection::Projection(const world::Camera& camera, const world::Mat4& toWorld) {
  const Vec3 forward = camera.pose.forward();
  const float focal = camera.focal();
  const world::Mat4 toObject = glm::transpose(toWorld);
  const auto plane = [&](Vec3 axis) { return toObject * world::Vec4(axis, -glm::dot(axis, camera.pose.position)); };
  u = plane(camera.pose.right() * focal + forward * (0.5F * static_cast<float>(camera.width)));
  v = plane(camera.pose.up() * -focal + forward * (0.5F * static_cast<float>(camera.height)));
  depth = plane(forward);
}

}  // namespace grove::raster
