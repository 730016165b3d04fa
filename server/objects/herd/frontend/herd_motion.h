#pragma once

#include <optional>

#include "node/messages.h"
#include "objects/herd/common/herd_snapshot.h"

namespace grove::objects::herd {

/// Where an animal is in a frame and how it moves, unless it stands, is far away or out of sight. `bounds`: its own at
/// the view's time.
[[nodiscard]] std::optional<node::Mover> moverOf(const HerdSnapshot& herd, const Animal& animal,
                                                 const world::Bounds& bounds, const node::View& view);

}  // namespace grove::objects::herd
