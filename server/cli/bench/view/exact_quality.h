#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string_view>

#include "cli/bench/picture_size.h"
#include "gl/workers.h"
#include "node/object_types.h"
#include "world/scenes/scene_file.h"
#include "world/walk.h"

namespace grove::cli {

/// What visitors of a busy server get.
struct Shed {
  double busyShare = 0.0;  ///< of the workers, see node/load_shedding.h
  int lines = 720;         ///< of their pictures
};

/// Difference from exact pictures: drawn for their eye, in full size, without shared views and backdrops.
struct ExactQuality {
  double meanDecibels = 0.0;   ///< PSNR of the mean square error over all frames
  double worstDecibels = 0.0;  ///< PSNR of the worst frame
};

/// Draws a walk at 30 frames per second as a busy server does, enlarges some of the pictures to `size`, and compares
/// them with exact ones. Smoke changes from moment to moment, so the scene's fluids are left out. Returns nothing if it
/// is stopped. Throws what WalkWorld throws.
[[nodiscard]] std::optional<ExactQuality> measureExactQuality(
    const world::Scene& scene, const node::ObjectTypes& types, gl::Workers& gl, const world::Walk& walk, double seconds,
    const PictureSize& size, const Shed& shed, const std::function<void(std::string_view, float)>& progress,
    const std::stop_token& stop);

}  // namespace grove::cli
