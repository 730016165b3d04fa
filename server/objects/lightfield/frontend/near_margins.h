#pragma once

#include "objects/lightfield/frontend/near_views.h"

namespace grove::objects::lightfield {

/// The part of an object in a visitor's own picture, in pixels of the frame: the object's box `rect` in the frame plus
/// margins, so that the picture also serves the next frames. Margins beyond the frame's edges assume that the head
/// continues to turn as it has since the last picture. `camera` is the frame's camera in object coordinates; `last` may
/// have no picture; a texel of the new picture is `times` as wide as a pixel.
[[nodiscard]] world::Rect withMargins(const world::Rect& rect, const world::Camera& frame, const ObjectCamera& camera,
                                      const NearView& last, float times);

}  // namespace grove::objects::lightfield
