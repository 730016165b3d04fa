#pragma once

#include "models/plants/limb.h"

namespace grove::models {

/// Appearances of bark; colours are relative to the material's.
[[nodiscard]] BarkLook oakBark(const BarkPlace& place);
[[nodiscard]] BarkLook birchBark(const BarkPlace& place);
[[nodiscard]] BarkLook spruceBark(const BarkPlace& place);
[[nodiscard]] BarkLook pineBark(const BarkPlace& place);
[[nodiscard]] BarkLook stalkBark(const BarkPlace& place);

/// Factor by which a trunk of this radius widens close above the ground, with protruding roots.
[[nodiscard]] float rootFlare(const BarkPlace& place, int roots);

}  // namespace grove::models
