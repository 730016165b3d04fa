#pragma once

#include "objects/lightfield/frontend/near_views.h"

namespace grove::objects::lightfield {

/// The part of an object that a visitor's own picture shows, in pixels of the frame. It begins with the object's box
/// `rect` in the frame and adds margins, so that the picture serves the next frames too. Beyond the frame's edges a
/// margin is as wide as a head needs that goes on turning as it has since the last picture. `camera` is the frame's in
/// the object's coordinates; `last` may have no picture; a texel of the new picture is `times` as wide as a pixel.
[[nodiscard]] world::Rect withMargins(const world::Rect& rect, const world::Camera& frame, const ObjectCamera& camera,
                                      const NearView& last, float times);

}  // namespace grove::objects::lightfield
