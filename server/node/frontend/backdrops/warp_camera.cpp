#include "node/frontend/backdrops/warp_camera.h"

namespace grove::node {
namespace {

/// Maps (column, row, 1) to the ray of that pixel.
glm::dmat3 raysOf(const world::Camera& camera) {
  const glm::dvec3 corner = camera.ray(0.0F, 0.0F);
  const double focal = camera.focal();
  return {glm::dvec3(camera.pose.right()) / focal, -glm::dvec3(camera.pose.up()) / focal, corner};
}

}  // namespace

WarpCamera::WarpCamera(const world::Camera& backdrop, const world::Camera& frame) {
  const glm::dmat3 inverse = glm::inverse(raysOf(backdrop));
  const glm::dmat3 rays = raysOf(frame);
  k = inverse * rays[2];
  kPerColumn = inverse * rays[0];
  kPerRow = inverse * rays[1];
  m = inverse * (glm::dvec3(frame.pose.position) - glm::dvec3(backdrop.pose.position));
}

}  // namespace grove::node
