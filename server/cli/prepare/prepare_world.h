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

/// What `--scene` says of itself, with the names of the built-in scenes.
[[nodiscard]] std::string aboutScene();

/// Loads a built-in scene, by its name, or a scene file; without either, the default scene. Throws world::SceneError or
/// EnvironmentError.
[[nodiscard]] world::Scene openScene(const std::optional<std::string>& nameOrFile);

/// Replaces the light fields' view error by that of `--view-error`, in pixels, if there is one.
void setViewError(world::Scene& scene, std::optional<float> viewError);

/// For measurements and comparisons of pictures: makes what the scene needs of these types and the cache folder lacks.
/// Returns false if it was stopped; finished parts are kept. Throws world::SceneError, EnvironmentError or ImportError.
[[nodiscard]] bool prepareWorld(const world::Scene& scene, const node::BackendTypes& types, Progress& progress,
                                const std::stop_token& stop);

/// For servers: shows what is in the cache folder, and coarse versions of the rest, made in seconds. Returns the
/// remaining preparations in the order to make them in; nothing if it was stopped. If the folder cannot be written, the
/// coarse versions are made for this run only and stay coarse, which the log reports, and no preparations remain.
/// Throws as prepareWorld().
[[nodiscard]] std::optional<Preparations> prepareFirstLook(const world::Scene& scene, const node::BackendTypes& types,
                                                           const std::function<void(std::string_view, float)>& progress,
                                                           const std::stop_token& stop);

}  // namespace grove::cli
