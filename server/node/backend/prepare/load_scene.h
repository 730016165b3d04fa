#pragma once

#include "node/backend/backend_half.h"
#include "node/messages/served_objects.h"
#include "node/type_table.h"
#include "world/scenes/scene_file.h"

namespace grove::node {

using BackendTypes = TypeTable<BackendType>;

/// Loads the models of a scene's objects. Throws world::SceneError.
[[nodiscard]] LoadedScene loadScene(const world::Scene& scene, const BackendTypes& types);

/// Loads the models of these objects only. The layout is complete, except for facts that only the other models provide.
[[nodiscard]] LoadedScene loadScene(const world::Scene& scene, const BackendTypes& types, const ServedObjects& own);

}  // namespace grove::node
