#pragma once

#include <array>

#include "world/light.h"

namespace grove::objects::ground {

/// The world's light as the loops need it, read once from world/light.h.
struct Daylight {
  world::Vec3 sun;  ///< unit vector towards it
  world::Vec3 sunColour;
  world::Vec3 sky;                ///< what level ground reflects of it
  world::Vec3 hazeAside;          ///< haze away from the sun
  world::Vec3 hazeGlow;           ///< what it gains towards the sun
  float logTransmittance = 0.0F;  ///< of one metre of air
  Daylight();
};

/// toDisplay() in steps of 1/kScale, as 0..255, not rounded.
struct ToneTable {
  static constexpr int kEntries = 4096;
  static constexpr float kScale = 1024.0F;
  std::array<float, kEntries> levels;
  ToneTable();
};

}  // namespace grove::objects::ground
