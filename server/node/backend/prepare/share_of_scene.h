#pragma once

#include <optional>
#include <span>
#include <string>

#include "node/backend/backend_services.h"
#include "node/backend/prepare/load_scene.h"
#include "node/messages/served_objects.h"
#include "world/scenes/scene_file.h"

namespace grove::node {

/// Resolves names in a scene: each is an object's name, or a type, which stands for all its objects (and the visitors,
/// if it is theirs). Returns nothing if a name is unknown, and sets `unknown` to it.
[[nodiscard]] std::optional<ServedObjects> namedObjects(const world::Layout& layout, std::span<const std::string> names,
                                                        std::string& unknown);

/// Returns a scene for a node that owns these objects only; the layout stays complete.
[[nodiscard]] LoadedScene shareOf(const LoadedScene& scene, const ServedObjects& own);
/// Returns a scene file with these objects only. Ids count within a file, so they differ from those of the whole scene.
[[nodiscard]] world::Scene shareOf(const world::Scene& scene, const ServedObjects& own);

/// Returns a type among these objects that needs the models of all objects; null if there is none.
[[nodiscard]] const BackendType* typeThatNeedsAllModels(const world::Layout& layout, const ServedObjects& own,
                                                        const BackendTypes& types);

}  // namespace grove::node
