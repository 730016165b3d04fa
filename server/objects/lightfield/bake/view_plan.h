#pragma once

#include <vector>

#include "models/model.h"
#include "objects/lightfield/format/view_camera.h"

namespace grove::bake {

/// From where an object is seen: around the place on the ground below its middle, framing the smallest ball around it,
/// from far enough away that every camera is outside of that ball.
[[nodiscard]] objects::lightfield::ViewGeometry planViews(const world::Triangles& triangles);

/// Cameras that are none of the views', to measure quality with: sixteen on the sphere of views, each amid the views
/// around it, from the horizon to the zenith; eight nearer or farther than it.
[[nodiscard]] std::vector<objects::lightfield::ObjectCamera> planHeldOut(
    const objects::lightfield::ViewGeometry& geometry, int subdivision, int size);

/// Cameras for a tile amid copies of itself, to measure the seams with: each looks at the middle of an edge, from where
/// visitors see it.
[[nodiscard]] std::vector<objects::lightfield::ObjectCamera> planSeams(
    const objects::lightfield::ViewGeometry& geometry, int size);

}  // namespace grove::bake
