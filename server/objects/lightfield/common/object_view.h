#pragma once

#include "objects/lightfield/common/haze.h"
#include "objects/lightfield/format/light_field.h"
#include "objects/lightfield/format/view_camera.h"
#include "world/camera.h"
#include "world/sky.h"

/// Converts a frame's camera to a light field's object coordinates.
namespace grove::objects::lightfield {

[[nodiscard]] ObjectCamera objectCamera(const world::Camera& camera, const world::Transform& transform);

/// The air between the eye and the middle of an object.
[[nodiscard]] Haze hazeBefore(const world::Bounds& worldBounds, const world::Sky& sky, const world::Camera& camera);

/// The mip level whose texels are about as large as the frame's pixels at the object.
[[nodiscard]] int levelFor(const LightField& field, const ObjectCamera& camera);

/// The same camera with pixels `times` as wide and high.
[[nodiscard]] ObjectCamera coarser(const ObjectCamera& camera, float times);

/// The part of `whole` that may show a box; all of it if part of the box is beside or behind the eye.
[[nodiscard]] world::Rect boxOf(const world::Bounds& bounds, const ObjectCamera& camera, const world::Rect& whole);

/// Width in pixels of the finest texels in the middle of the object.
[[nodiscard]] float texelWidth(const ViewGeometry& geometry, int viewSize, const ObjectCamera& camera);

/// Width in pixels of the finest texels in the middle of the object's far half, at least 1. A picture with one sample
/// per this many pixels shows nearly all detail of the texels; farther parts are mostly hidden.
[[nodiscard]] float magnification(const ViewGeometry& geometry, int viewSize, const ObjectCamera& camera);

}  // namespace grove::objects::lightfield
