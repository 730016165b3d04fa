#pragma once

#include <span>
#include <string_view>

#include "world/layout.h"
#include "world/scenes/scene_file.h"

namespace grove::world {

/// The part of a scene's layout that does not depend on models: everything except bounds, obstacles and other facts about
/// models in VisitorTemplate. Ids and type indices are the same in every process that reads the file. Throws SceneError
/// for an object whose type is not among `knownTypes`.
[[nodiscard]] Layout layoutOf(const Scene& scene, std::span<const std::string_view> knownTypes);

}  // namespace grove::world
