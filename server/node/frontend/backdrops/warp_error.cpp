#include "node/frontend/backdrops/warp_error.h"

#include <algorithm>
#include <cmath>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::node {
namespace {

/// Pixels, root mean square.
constexpr float kPermittedShift = 1.8F;
/// Octaves, root mean square.
constexpr float kPermittedZoom = 0.1F;

}  // namespace

float warpError(const Backdrop& backdrop, const world::Camera& camera) {
  const Backdrop::Error error = backdrop.errorOf(WarpCamera(backdrop.view().camera, camera));
  return std::max(error.shift / kPermittedShift, error.zoom / kPermittedZoom);
}

}  // namespace grove::node
