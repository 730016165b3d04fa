#pragma once

#include <optional>

#include "world/camera.h"

namespace grove::node {

/// The part of a backdrop that a frame shows, in pixels of the backdrop's camera: the box of where the frame's edges
/// lie, for what is at least `nearest` metres away. Nothing of it is in the backdrop if it is empty.
[[nodiscard]] world::Rect seenPart(const world::Camera& backdrop, const world::Camera& frame, float nearest);

/// The area of a backdrop for a frame: the frame and a border for what `later` sees beside it. Nothing if that is too
/// much to draw.
[[nodiscard]] std::optional<world::Rect> areaWithBorder(const world::Camera& camera, const world::Camera& later,
                                                        float nearest);

/// The area without a border. Areas have even edges.
[[nodiscard]] world::Rect evenFrame(const world::Camera& camera);

}  // namespace grove::node
