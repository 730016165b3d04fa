#pragma once

#include "models/plants/limb.h"

namespace grove::models {

/// Looks of bark; colours are relative to the material's.
[[nodiscard]] BarkLook oakBark(const BarkPlace& place);
[[nodiscard]] BarkLook birchBark(const BarkPlace& place);
[[nodiscard]] BarkLook spruceBark(const BarkPlace& place);
[[nodiscard]] BarkLook stalkBark(const BarkPlace& place);

/// How much wider a trunk of this radius is close above the ground, with roots that stand out.
[[nodiscard]] float rootFlare(const BarkPlace& place, int roots);

}  // namespace grove::models
