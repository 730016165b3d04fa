#pragma once

#include "node/frontend/backdrops/backdrop.h"

namespace grove::node {

/// How wrong the light of a backdrop is because lights have flickered, moved, come or gone since: a multiple of the
/// permitted error.
[[nodiscard]] float lightError(const Backdrop& backdrop, const std::vector<world::PointLight>& now);

}  // namespace grove::node
