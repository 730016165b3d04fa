#pragma once

#include <span>
#include <string_view>

#include "world/layout.h"
#include "world/scenes/scene_file.h"

namespace grove::world {

/// What a scene file alone says of its layout: all but what depends on models, which are bounds, obstacles and whether
/// visitors have bodies of their own. Ids and type indices are the same in every process that reads the file. Throws
/// SceneError for an object of a type that is not among `knownTypes`.
[[nodiscard]] Layout layoutOf(const Scene& scene, std::span<const std::string_view> knownTypes);

}  // namespace grove::world
