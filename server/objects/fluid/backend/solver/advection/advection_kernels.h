#pragma once

#include <cstddef>

#include "objects/fluid/backend/solver/grid.h"

/// The passes of advection (Advection) over one plane of values. Pointers are to the first value of the plane's row 0;
/// all planes lie as those of a Layout do.
namespace grove::objects::fluid {

/// Values of a plane, without ghosts.
struct PlaneExtent {
  int columns = 0;
  int firstRow = 0;
  int endRow = 0;
  std::ptrdiff_t stride = 0;  ///< between rows
};

/// A plane and its neighbours, ghosts included.
struct SampledPlanes {
  const float* below = nullptr;
  const float* here = nullptr;
  const float* above = nullptr;
};

/// The velocity where the values lie, in metres a second; `scale` makes it cells over the step.
struct Moves {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  float scale = 1.0F;
};

/// A semi-Lagrangian value, and the extremes of the eight values that it was interpolated from.
struct Samples {
  float* value = nullptr;
  float* low = nullptr;
  float* high = nullptr;
};

/// out = the mean of four planes; and of two.
void meanOfFour(const PlaneExtent& extent, const float* a, const float* b, const float* c, const float* d, float* out);
void meanOfTwo(const PlaneExtent& extent, const float* a, const float* b, float* out);

/// The longest move along any axis, in cells.
[[nodiscard]] float longestMove(const PlaneExtent& extent, const Moves& moves);

/// Values at i - move, |move| <= 1, by trilinear interpolation. Up to 3 values behind the rows' ends are written, too.
void sampleNear(const PlaneExtent& extent, const SampledPlanes& planes, const Moves& moves, const Samples& samples);

/// MacCormack's correction by what sampling `forth` at i + move gives: forth + (in - back) / 2, within the extremes.
void correctSamples(const PlaneExtent& extent, const SampledPlanes& forth, const Moves& moves, const float* in,
                    const float* low, const float* high, float* out);

/// Rows from `first` to ahead of `end`; none if they are not in order.
struct RowRange {
  int first = 0;
  int end = 0;
};
/// The rows of an extent that lie around all values but zeros.
[[nodiscard]] RowRange filledRows(const PlaneExtent& extent, const float* values);

}  // namespace grove::objects::fluid
