#include "objects/ground/common/daylight.h"

#include <cmath>

namespace grove::objects::ground {

// hazeColour() is a constant and a glow that grows with the sun's cosine: both are read off its one definition.
Daylight::Daylight()
    : sun(world::sunDirection()),
      sunColour(world::sunColour()),
      sky(world::ambient(world::Vec3(0, 1, 0))),
      hazeAside(world::hazeColour(-sun)),
      hazeGlow(world::hazeColour(sun) - hazeAside),
      logTransmittance(std::log(1.0F - world::hazeAmount(100.0F)) / 100.0F) {}

ToneTable::ToneTable() : levels{} {
  for (std::size_t i = 0; i < kEntries; ++i) {
    levels[i] = world::toDisplay((static_cast<float>(i) + 0.5F) / kScale) * 255.0F;
  }
}

}  // namespace grove::objects::ground
