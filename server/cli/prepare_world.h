#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "cli/progress.h"
#include "world/scene_file.h"

namespace grove::cli {

/// The scene of a file, or the grove, which is built in. Throws world::SceneError or EnvironmentError.
[[nodiscard]] world::Scene openScene(const std::optional<std::string>& file);

/// Bakes the light fields that a scene names by plant or model and that the cache folder does not have yet. Returns
/// false if it was stopped; what was done by then is kept. Throws world::SceneError, EnvironmentError or ImportError.
[[nodiscard]] bool prepareWorld(const world::Scene& scene, Progress& progress, const std::stop_token& stop);

}  // namespace grove::cli
