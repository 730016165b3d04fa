#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "cli/prepare/light_fields.h"
#include "cli/prepare/progress.h"
#include "objects/lightfield/backend/light_field_backend_type.h"
#include "world/scene_file.h"

namespace grove::cli {

/// The scene of a file, or the grove, which is built in. Throws world::SceneError or EnvironmentError.
[[nodiscard]] world::Scene openScene(const std::optional<std::string>& file);

/// For those who measure or compare pictures: bakes the light fields that a scene names by plant or model and that the
/// cache folder does not have yet. Returns false if it was stopped; what was done by then is kept. Throws
/// world::SceneError, EnvironmentError or ImportError.
[[nodiscard]] bool prepareWorld(const world::Scene& scene, Progress& progress, const std::stop_token& stop);

/// What a world can be shown with soon.
struct FirstLook {
  objects::lightfield::KnownFields fields;  ///< all that the scene wants, by the finest file
  std::vector<WantedField> rough;           ///< whose finest file is still to be made, in the order to make them in
};

/// For those who serve: opens what is in the cache folder, and makes something rough of the rest, in seconds. If
/// nothing can be kept there, it is made for this once and stays as it is, which the log reports. Nothing if it was
/// stopped. Throws as prepareWorld().
[[nodiscard]] std::optional<FirstLook> prepareFirstLook(const world::Scene& scene,
                                                        const std::function<void(std::string_view, float)>& progress,
                                                        const std::stop_token& stop);

}  // namespace grove::cli
