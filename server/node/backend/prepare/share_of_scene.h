#pragma once

#include <optional>
#include <span>
#include <string>

#include "node/backend/backend_services.h"
#include "node/backend/prepare/load_scene.h"
#include "node/messages/served_objects.h"
#include "world/scenes/scene_file.h"

namespace grove::node {

/// What these names of objects and types mean in a scene: an object by its name, or all of a type, which may be that of
/// the visitors. Nothing, and `unknown` is the name, if one means nothing.
[[nodiscard]] std::optional<ServedObjects> namedObjects(const world::Layout& layout, std::span<const std::string> names,
                                                        std::string& unknown);

/// A scene for a node that owns these objects only; the layout stays whole.
[[nodiscard]] LoadedScene shareOf(const LoadedScene& scene, const ServedObjects& own);
/// Returns a scene file with these objects only. Ids count within a file, so they differ from those of the whole scene.
[[nodiscard]] world::Scene shareOf(const world::Scene& scene, const ServedObjects& own);

/// The type of an object among these that needs the models of all objects; null: there is none.
[[nodiscard]] const BackendType* typeThatNeedsAllModels(const world::Layout& layout, const ServedObjects& own,
                                                        const BackendTypes& types);

}  // namespace grove::node
