#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "world/scenes/scene_file.h"

namespace grove::world {

/// Reads one `[[hill]]` of a scene file. Throws SceneError.
[[nodiscard]] Hill readHill(const Parameters& parameters);

/// Returns the index of a hill on which the ground is higher than kMaxGroundHeight.
[[nodiscard]] std::optional<std::size_t> tooHighHill(std::span<const Hill> hills);

/// Raises the scene's objects, lights and spawn, whose heights count from the ground below, and leans objects with it.
/// The ground and the sky stay, and fluids do not lean, because their cubes are upright.
void standOnGround(Scene& scene);

}  // namespace grove::world
