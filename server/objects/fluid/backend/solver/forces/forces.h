#pragma once

#include <array>
#include <span>

#include "objects/fluid/backend/solver/grid.h"
#include "world/edits.h"
#include "world/geometry.h"

namespace grove::objects::fluid {

/// The air around the fluid.
struct Air {
  world::Vec3 wind{0.0F};   ///< metres per second
  float response = 0.0F;    ///< share of the difference to the wind that vanishes per second
  float turbulence = 0.0F;  ///< metres per second, maximum of the wind's slowly changing whirls
  float buoyancy = 7.0F;    ///< metres per second squared at temperature 1
};

/// Adds buoyancy and the drag of a wind with slowly changing whirls (two octaves of Arnold-Beltrami-Childress flow,
/// which is free of divergence) to all faces. `time` in seconds selects the state of the whirls. Ghosts must be filled.
void applyForces(const Layout& layout, const Air& air, const Field& temperature, double time, float seconds,
                 float cellSize, Velocity& velocity);

/// Applies a gust: faces in its cone approach the wind's speed within one tick. The gust is in the fluid's own
/// coordinates, with a unit direction.
void applyGust(const Layout& layout, const world::Gust& gust, float cellSize, Velocity& velocity);

/// Cools by radiation (fast while hot) and by mixing with the surrounding air.
void cool(const Layout& layout, float seconds, Field& temperature);

/// Heats a disc-shaped source: temperature rises towards 1 within `radius` metres of the centre and flickers with
/// `time`.
struct HeatSource {
  world::Vec3 centre{0.0F};
  float radius = 0.35F;  ///< metres
  float flicker = 0.3F;  ///< 0 steady to 1 wild
};
void heat(const Layout& layout, const HeatSource& source, double time, float seconds, float cellSize,
          Field& temperature);

}  // namespace grove::objects::fluid
