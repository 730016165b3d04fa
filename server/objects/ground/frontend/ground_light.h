#pragma once

#include <array>

#include "world/sky.h"

namespace grove::objects::ground {

/// A table of world::toDisplay() in steps of 1/kScale, as 0..255, not rounded.
struct ToneTable {
  static constexpr int kEntries = 4096;
  static constexpr float kScale = 1024.0F;
  std::array<float, kEntries> levels;
  ToneTable();
};

/// A world's sky and air in the form that the loops need.
struct GroundLight {
  world::Vec3 sun;  ///< unit vector towards it
  world::Vec3 sunColour;
  world::Vec3 ambient;            ///< sky light that level ground reflects
  world::Vec3 hazeAside;          ///< haze away from the sun
  world::Vec3 hazeGlow;           ///< haze added towards the sun
  float logTransmittance = 0.0F;  ///< per metre of air
  ToneTable tone;
  explicit GroundLight(const world::Sky& sky);
};

}  // namespace grove::objects::ground
