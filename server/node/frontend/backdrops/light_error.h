#pragma once

#include "node/frontend/backdrops/backdrop.h"

namespace grove::node {

/// Error of a backdrop's light, because lights have flickered, moved, appeared or gone since: a multiple of the
/// permitted error.
[[nodiscard]] float lightError(const Backdrop& backdrop, const std::vector<world::PointLight>& now);

}  // namespace grove::node
