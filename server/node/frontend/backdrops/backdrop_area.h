#pragma once

#include <optional>

#include "world/camera.h"

namespace grove::node {

/// Bounding box of the part of a backdrop that a frame shows, in pixels of the backdrop's camera, for surfaces at least
/// `nearest` metres away. Empty if the frame looks elsewhere.
[[nodiscard]] world::Rect seenPart(const world::Camera& backdrop, const world::Camera& frame, float nearest);

/// Area of a backdrop: the frame, with a border for what the camera `later` sees outside the frame. Nothing if the
/// border costs too much to draw.
[[nodiscard]] std::optional<world::Rect> areaWithBorder(const world::Camera& camera, const world::Camera& later,
                                                        float nearest);

/// Area without a border. All areas have even edges.
[[nodiscard]] world::Rect evenFrame(const world::Camera& camera);

}  // namespace grove::node
