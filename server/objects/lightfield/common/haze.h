#pragma once

#include <array>

namespace grove::objects::lightfield {

/// What the air adds on the way, the same for a whole object; display-encoded like the colours it is mixed into.
struct Haze {
  std::array<float, 3> colour{};  ///< 0..1
  float amount = 0.0F;            ///< result = colour * (1 - amount) + haze.colour * coverage * amount
};

}  // namespace grove::objects::lightfield
