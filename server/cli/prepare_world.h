#pragma once

#include <stop_token>

#include "cli/progress.h"
#include "world/scene_file.h"

namespace grove::cli {

/// Bakes the light fields that a scene names by plant or model and that the cache folder does not have yet. Returns
/// false if it was stopped; what was done by then is kept. Throws world::SceneError, EnvironmentError or ImportError.
[[nodiscard]] bool prepareWorld(const world::Scene& scene, Progress& progress, const std::stop_token& stop);

}  // namespace grove::cli
