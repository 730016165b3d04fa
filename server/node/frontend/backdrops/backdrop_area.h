#pragma once

#include <optional>
#include <vector>

#include "world/camera.h"

namespace grove::node {

/// Bounding box of the part of a backdrop that a frame shows, in pixels of the backdrop's camera, for surfaces at least
/// `nearest` metres away. Empty if the frame looks elsewhere.
[[nodiscard]] world::Rect seenPart(const world::Camera& backdrop, const world::Camera& frame, float nearest);

/// Area of a backdrop of `camera`: the part that the frame sees, with a border for the part that is seen `later`. Empty
/// if drawing it costs too much.
[[nodiscard]] std::optional<world::Rect> areaWithBorder(const world::Rect& seen, const world::Rect& later,
                                                        const world::Camera& camera);

/// The cells that a rectangle overlaps. All areas consist of whole cells.
[[nodiscard]] world::Rect wholeCells(const world::Rect& rect);

/// Returns the area of an extended backdrop: what a frame sees of it, in pixels of the backdrop's camera, a border for
/// what is seen `later`, and the present `area` if the result does not become too large. Returns nothing if the result
/// is too large, or if `seen` or `later` is empty.
[[nodiscard]] std::optional<world::Rect> extendedArea(const world::Rect& area, const world::Rect& seen,
                                                      const world::Rect& later, const world::Camera& camera);

/// Returns the parts of an area outside of another: rectangles without overlap, none of them empty.
[[nodiscard]] std::vector<world::Rect> partsBeyond(const world::Rect& area, const world::Rect& other);

}  // namespace grove::node
