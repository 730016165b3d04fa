#include "objects/lightfield/format/view_camera.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::lightfield {

bool seesItsBall(const ViewGeometry& geometry) noexcept {
  return glm::distance(geometry.centre, geometry.target) + geometry.extent < geometry.radius;
}

ViewCamera viewCamera(const ViewGeometry& geometry, world::Vec3 direction) noexcept {
  ViewCamera camera;
  camera.eye = geometry.centre + geometry.radius * direction;
  const world::Vec3 towards = geometry.target - camera.eye;
  const float distance = glm::length(towards);
  camera.forward = towards / distance;
  // Straight down there is no "up"; any fixed choice works, since every view is projected into separately.
  const world::Vec3 across = glm::cross(camera.forward, world::Vec3(0.0F, 1.0F, 0.0F));
  const float length = glm::length(across);
  camera.right = length > 1.0e-4F ? across / length : world::Vec3(1.0F, 0.0F, 0.0F);
  camera.down = glm::cross(camera.forward, camera.right);
  // The cone tangent to the ball.
  const float sine = std::min(geometry.extent / distance, 0.999F);
  camera.focal = 0.5F * std::sqrt(1.0F - sine * sine) / sine;
  camera.nearDepth = distance - geometry.extent;
  camera.farDepth = distance + geometry.extent;
  return camera;
}

ObjectCamera objectCamera(const ViewCamera& camera, int size) noexcept {
  const float step = 1.0F / (camera.focal * static_cast<float>(size));
  ObjectCamera result;
  result.eye = camera.eye;
  result.perColumn = camera.right * step;
  result.perRow = camera.down * step;
  result.corner = camera.forward - (camera.right + camera.down) * (0.5F / camera.focal);
  return result;
}

}  // namespace grove::objects::lightfield
