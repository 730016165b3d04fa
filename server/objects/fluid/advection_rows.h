#pragma once

#include <cstddef>

#include "objects/fluid/advection.h"

/// The inner loops of advection, one row of values at a time.
namespace grove::objects::fluid::rows {

/// More than any row of faces, with room for whole vectors.
inline constexpr int kLongestAdvected = 160;

/// Displacements in cells over the step, a row of each.
struct Moves {
  float* x;
  float* y;
  float* z;
};

/// Rows of the plane below, this one and the one above.
struct Planes {
  const float* below;
  const float* here;
  const float* above;
};

struct Samples {
  float* value;
  float* low;
  float* high;
};

/// Values at i - sign * move, |move| <= 1, by trilinear interpolation; with the extremes of the eight samples if
/// wanted. `s` is the distance to the next row.
template <bool kExtremes>
void sampleNear(const Planes& planes, std::ptrdiff_t s, const Moves& moves, float sign, int length,
                const Samples& samples);

/// Values at (i, y, z) - move, however far, held within the ghosts. `counts` are the values along each axis.
void sampleFar(const Layout& layout, const float* field, int y, int z, const Moves& moves, const int (&counts)[3],
               const Samples& samples);

/// Velocity at the places of the row at `at`, times `scale`; returns the largest component.
float movesOfRow(Place place, const Layout& layout, const Velocity& velocity, std::ptrdiff_t at, float scale,
                 int length, const Moves& moves);

}  // namespace grove::objects::fluid::rows
