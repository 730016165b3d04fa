#pragma once

#include <cstddef>

#include "objects/fluid/backend/solver/grid.h"

/// Advection's passes over one plane of values. Pointers are to the first value of the plane's row 0; all planes have
/// the strides of a Layout.
namespace grove::objects::fluid {

/// Extent of a plane without ghosts.
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

/// The velocity at the values' locations, in metres per second; `scale` converts it to cells per step.
struct Moves {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  float scale = 1.0F;
};

/// A semi-Lagrangian value, and the min/max of the eight values that it was interpolated from.
struct Samples {
  float* value = nullptr;
  float* low = nullptr;
  float* high = nullptr;
};

/// out = the mean of four planes or of two.
void meanOfFour(const PlaneExtent& extent, const float* a, const float* b, const float* c, const float* d, float* out);
void meanOfTwo(const PlaneExtent& extent, const float* a, const float* b, float* out);

/// Longest move along any axis, in cells.
[[nodiscard]] float longestMove(const PlaneExtent& extent, const Moves& moves);

/// Values at i - move, |move| <= 1, by trilinear interpolation. Writes up to 3 values beyond the rows' ends.
void sampleNear(const PlaneExtent& extent, const SampledPlanes& planes, const Moves& moves, const Samples& samples);

/// MacCormack's correction from the samples of `forth` at i + move: forth + (in - back) / 2, clamped to [low, high].
void correctSamples(const PlaneExtent& extent, const SampledPlanes& forth, const Moves& moves, const float* in,
                    const float* low, const float* high, float* out);

/// Rows from `first` to before `end`; empty if end <= first.
struct RowRange {
  int first = 0;
  int end = 0;
};
/// The smallest row range that contains all non-zero values.
[[nodiscard]] RowRange filledRows(const PlaneExtent& extent, const float* values);

}  // namespace grove::objects::fluid
