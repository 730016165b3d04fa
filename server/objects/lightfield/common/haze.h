#pragma once

#include <array>

namespace grove::objects::lightfield {

/// The air between eye and object, constant over an object; display-encoded like the colours that it is mixed into.
struct Haze {
  std::array<float, 3> colour{};  ///< 0..1
  float amount = 0.0F;            ///< result = colour * (1 - amount) + haze.colour * coverage * amount
};

}  // namespace grove::objects::lightfield
