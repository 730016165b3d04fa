#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "cli/prepare/progress.h"
#include "node/backend/prepare/load_scene.h"
#include "node/backend/prepare/preparation.h"
#include "world/scenes/scene_file.h"

namespace grove::cli {

using Preparations = std::vector<std::unique_ptr<node::Preparation>>;

/// The scene of a file, or the grove, which is built in. Throws world::SceneError or EnvironmentError.
[[nodiscard]] world::Scene openScene(const std::optional<std::string>& file);

/// Replaces the scene's view error of light fields by that of `--view-error`, in pixels. Changes nothing without one.
void setViewError(world::Scene& scene, std::optional<float> viewError);

/// For those who measure or compare pictures: makes what the scene needs of these types that the cache folder does not
/// have yet. Returns false if it was stopped; what was done by then is kept. Throws world::SceneError, EnvironmentError
/// or ImportError.
[[nodiscard]] bool prepareWorld(const world::Scene& scene, const node::BackendTypes& types, Progress& progress,
                                const std::stop_token& stop);

/// For those who serve: shows what is in the cache folder, and something rough of the rest, made in seconds. What is
/// left to be made is the answer, in the order to make it in. If nothing can be kept there, what is rough is made for
/// this once and stays as it is, which the log reports, and nothing is left. No answer if it was stopped. Throws as
/// prepareWorld().
[[nodiscard]] std::optional<Preparations> prepareFirstLook(const world::Scene& scene, const node::BackendTypes& types,
                                                           const std::function<void(std::string_view, float)>& progress,
                                                           const std::stop_token& stop);

}  // namespace grove::cli
