#pragma once

#include <optional>
#include <vector>

#include "world/camera.h"

namespace grove::node {

/// Bounding box of the part of a backdrop that a frame shows, in pixels of the backdrop's camera, for surfaces at least
/// `nearest` metres away. Empty if the frame looks elsewhere.
[[nodiscard]] world::Rect seenPart(const world::Camera& backdrop, const world::Camera& frame, float nearest);

/// Area of a backdrop of `camera`: what the frame sees of it, with a border for what is seen `later`. Nothing if that
/// costs too much to draw.
[[nodiscard]] std::optional<world::Rect> areaWithBorder(const world::Rect& seen, const world::Rect& later,
                                                        const world::Camera& camera);

/// The cells that a rectangle overlaps. All areas consist of whole cells.
[[nodiscard]] world::Rect wholeCells(const world::Rect& rect);

/// Area without a border.
[[nodiscard]] world::Rect areaOfFrame(const world::Camera& camera);

/// Area of a backdrop that is extended: what a frame sees of it, in pixels of the backdrop's camera, with a border for
/// what is seen `later`, and as much of its area as may be kept. Nothing if that
/// would be too large, or if the frame or what is seen later is elsewhere.
[[nodiscard]] std::optional<world::Rect> extendedArea(const world::Rect& area, const world::Rect& seen,
                                                      const world::Rect& later, const world::Camera& camera);

/// What an area has beyond another: rectangles that do not overlap, none of them empty.
[[nodiscard]] std::vector<world::Rect> partsBeyond(const world::Rect& area, const world::Rect& other);

}  // namespace grove::node
