#include "objects/ground/frontend/ground_light.h"

#include <cmath>

#include "world/light.h"

namespace grove::objects::ground {

ToneTable::ToneTable() : levels{} {
  for (std::size_t i = 0; i < kEntries; ++i) {
    levels[i] = world::toDisplay((static_cast<float>(i) + 0.5F) / kScale) * 255.0F;
  }
}

// hazeColour() is a constant plus a glow that grows with the sun's cosine; both are read from hazeColour() itself.
GroundLight::GroundLight(const world::Sky& sky)
    : sun(sky.sun),
      sunColour(sky.sunColour),
      ambient(sky.ambient({0, 1, 0})),
      hazeAside(sky.hazeColour(-sun)),
      hazeGlow(sky.hazeColour(sun) - hazeAside),
      logTransmittance(std::log(1.0F - world::hazeAmount(100.0F)) / 100.0F) {}

}  // namespace grove::objects::ground
