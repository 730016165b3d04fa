#pragma once

#include <vector>

#include "world/scenes/scene_file.h"

namespace grove::world {

/// Reads one object of a scene file. Throws SceneError.
[[nodiscard]] ObjectDescription readObject(const Parameters& parameters);

/// Reads a table of `[[object]]`: the object, or its copies at the table's `places`, numbered from 1. Throws
/// SceneError.
[[nodiscard]] std::vector<ObjectDescription> readObjects(const Parameters& parameters);

}  // namespace grove::world
