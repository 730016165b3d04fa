#pragma once

#include "world/scenes/scene_file.h"

namespace grove::world {

/// Reads one `[[hill]]` of a scene file. Throws SceneError.
[[nodiscard]] Hill readHill(const Parameters& parameters);

/// Whether the ground is nowhere higher than kMaxGroundHeight.
[[nodiscard]] bool areLowEnough(const std::vector<Hill>& hills);

/// Raises the scene's objects, lights and spawn, whose heights count from the ground, and leans objects with it.
void standOnGround(Scene& scene);

}  // namespace grove::world
