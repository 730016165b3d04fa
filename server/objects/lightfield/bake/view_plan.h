#pragma once

#include <vector>

#include "models/model.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::bake {

/// Chooses the view geometry of an object: around the point on the ground below its middle, framing its smallest
/// enclosing ball, from far enough away that every camera is outside that ball.
[[nodiscard]] objects::lightfield::ViewGeometry planViews(const world::Triangles& triangles);

/// Held-out cameras for measuring quality: sixteen on the sphere of views, each between views, from the horizon to the
/// zenith; eight nearer or farther than it.
[[nodiscard]] std::vector<objects::lightfield::ObjectCamera> planHeldOut(
    const objects::lightfield::ViewGeometry& geometry, int subdivision, int size);

/// Cameras for measuring the seams of a tile amid copies of itself: each looks at the middle of an edge from a
/// visitor's position.
[[nodiscard]] std::vector<objects::lightfield::ObjectCamera> planSeams(
    const objects::lightfield::ViewGeometry& geometry, int size);

}  // namespace grove::bake
