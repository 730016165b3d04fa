#pragma once

#include "node/frontend/backdrops/backdrop.h"

namespace grove::node {

/// Error of a backdrop that is shown to a camera, in multiples of what is permitted: pixels are shifted wrongly, or it
/// is too small.
[[nodiscard]] float warpError(const Backdrop& backdrop, const world::Camera& camera);

/// How much the lights have changed between two views, in multiples of what is permitted.
[[nodiscard]] float lightError(const View& before, const View& now);

}  // namespace grove::node
