#pragma once

#include <cstddef>

#include "objects/fluid/advection.h"
#include "objects/fluid/half.h"

/// The inner loops of advection, over rows of packed halves. `s` is the distance to the next row.
namespace grove::objects::fluid::rows {

/// More than any row of faces, with room for whole vectors.
inline constexpr int kLongestAdvected = 160;

/// Displacements in cells over the step, of each value.
struct Moves {
  Half* x;
  Half* y;
  Half* z;
};

/// The plane below, this one and the one above.
struct Planes {
  const Half* below;
  const Half* here;
  const Half* above;
};

struct Samples {
  Half* value;
  Half* low;
  Half* high;
};

/// Values at i - move, |move| <= 1, by trilinear interpolation, with the extremes of the eight samples.
void sampleForth(const Planes& planes, std::ptrdiff_t s, const Moves& moves, int length, const Samples& samples);

/// MacCormack's correction by what sampling `forth` at i + move gives: forth + (in - back) / 2, within the extremes.
/// kChange: what has to be added to `in`, rather than the value.
template <bool kChange>
void correct(const Planes& forth, std::ptrdiff_t s, const Moves& moves, const Half* in, const Half* low,
             const Half* high, int length, Half* out);

/// Values of a row at (i, y, z) - move, however far, held within the ghosts. `counts` are the values along each axis.
void sampleFar(const Layout& layout, const float* field, int y, int z, const Moves& moves, const int (&counts)[3],
               float* out);

/// A component of the velocity at other places than its own: the mean of four values.
void meanOfFour(const Half* a, const Half* b, const Half* c, const Half* d, int length, Half* out);
/// The same in the middle of cells: the mean of two.
void meanOfTwo(const Half* a, const Half* b, int length, Half* out);

/// Whether any move of a row is longer than a cell along any axis.
[[nodiscard]] bool anyFar(const Moves& moves, int length);

}  // namespace grove::objects::fluid::rows
