#include "node/frontend/backdrops/warp_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::node {
namespace {

/// Pixels, root mean square.
constexpr float kPermittedShift = 1.2F;
/// Octaves by which the nearest may be larger or smaller in the backdrop.
constexpr float kPermittedZoom = 0.2F;
/// Share of a light's colour.
constexpr float kPermittedLight = 0.25F;
constexpr float kMinDepth = 1.0e-3F;

}  // namespace

float warpError(const Backdrop& backdrop, const world::Camera& camera) {
  const WarpCamera warp(backdrop.view().camera, camera);
  float zoom = 0.0F;
  if (backdrop.nearest() > 0.0F) {
    const float depth = 1.0F / backdrop.nearest();
    zoom = std::log2(depth / std::max(depth - warp.m.z, kMinDepth));
  }
  return std::max(backdrop.shiftError(warp) / kPermittedShift, std::abs(zoom) / kPermittedZoom);
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
