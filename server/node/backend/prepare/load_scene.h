#pragma once

#include "node/backend/backend_half.h"
#include "node/messages/served_objects.h"
#include "node/type_table.h"
#include "world/scenes/scene_file.h"

namespace grove::node {

using BackendTypes = TypeTable<BackendType>;

/// Loads what a scene's objects are made of, by their types. Throws world::SceneError.
[[nodiscard]] LoadedScene loadScene(const world::Scene& scene, const BackendTypes& types);

/// The same of these objects only. The layout is whole, but for what only models tell of the others.
[[nodiscard]] LoadedScene loadScene(const world::Scene& scene, const BackendTypes& types, const ServedObjects& own);

}  // namespace grove::node
