#include "node/frontend/backdrops/warp_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::node {
namespace {

/// Pixels, root mean square.
constexpr float kPermittedShift = 0.9F;
/// Octaves, root mean square.
constexpr float kPermittedZoom = 0.1F;
/// Share of a light's colour.
constexpr float kPermittedLight = 0.25F;

}  // namespace

float warpError(const Backdrop& backdrop, const world::Camera& camera) {
  const Backdrop::Error error = backdrop.errorOf(WarpCamera(backdrop.view().camera, camera));
  return std::max(error.shift / kPermittedShift, error.zoom / kPermittedZoom);
}

float lightError(const View& before, const View& now) {
  if (before.lights.size() != now.lights.size()) return std::numeric_limits<float>::infinity();
  float most = 0.0F;
  for (std::size_t i = 0; i < now.lights.size(); ++i) {
    const float was = glm::length(before.lights[i].colour);
    most = std::max(most, glm::distance(before.lights[i].colour, now.lights[i].colour) / std::max(was, 1.0e-6F));
  }
  return most / kPermittedLight;
}

}  // namespace grove::node
