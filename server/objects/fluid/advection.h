#pragma once

#include <vector>

#include "objects/fluid/grid.h"

namespace grove::objects::fluid {

enum class AdvectionOrder {
  kSemiLagrangian,  ///< Stam 1999: stable, diffusive
  kMacCormack,      ///< Selle et al. 2008: corrected by the error of the way back, clamped to the eight samples
};

/// Where a field's values lie: on the faces of an axis, or in the middle of the cells.
enum class Place { kFaceX = 0, kFaceY = 1, kFaceZ = 2, kCentre = 3 };

/// Carries fields along a velocity. Unconditionally stable: no value leaves the range of its neighbours. Rows in which
/// all move by less than a cell, almost all of them, need no gathers: their samples lie among known neighbours. Rows
/// with larger moves are sampled wherever they end, without MacCormack's correction. One thread; keeps scratch memory.
class Advection {
 public:
  explicit Advection(const Layout& layout);

  /// `seconds` over `cellSize` metres. Ghosts of `from` and `velocity` must be filled; those of `to` are left alone.
  void advect(Place place, const Field& from, const Velocity& velocity, float seconds, float cellSize,
              AdvectionOrder order, Field& to);

 private:
  const Layout layout_;
  Field scratch_;  ///< planes of the first pass
};

/// Fills the ghosts: what lies outside of a cell or face at the border equals it; a velocity across a closed side is 0.
void fillVelocityGhosts(const Layout& layout, const Sides& sides, Velocity& velocity);

/// Ghosts of a field of cell centres: outside of open sides there is fresh air (0), at walls the nearest value.
void fillCentreGhosts(const Layout& layout, const Sides& sides, Field& field);

}  // namespace grove::objects::fluid
