#pragma once

#include <optional>

#include "node/messages.h"

namespace grove::objects::figure {

/// Returns where a visitor's figure is in a frame of this camera and how it moves, so that pages and encoders can follow
/// it. Nothing if the visitor stands, is too far away for the difference to be seen, or is out of view.
[[nodiscard]] std::optional<node::Mover> moverOf(const world::Object& object, const world::Player& player,
                                                 const world::Camera& camera);

}  // namespace grove::objects::figure
