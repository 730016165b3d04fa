#pragma once

#include "node/frontend/backdrops/backdrop.h"

namespace grove::node {

/// Error of a backdrop warped to a camera, in multiples of the permitted error: the larger of wrong shifts and of
/// wrong scales, see Backdrop::errorOf().
[[nodiscard]] float warpError(const Backdrop& backdrop, const world::Camera& camera);

}  // namespace grove::node
