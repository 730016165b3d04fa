#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "objects/fluid/backend/solver/pressure/pressure_operator.h"

/// What FineSweep does to a plane at a time. Pointers are to the first cell of a plane's row 0.
namespace grove::objects::fluid {

/// Stages of the finest level's smoother: a Chebyshev polynomial of Jacobi.
inline constexpr int kFineStages = 10;

/// How the planes lie that the sweep keeps: rows of whole vectors, what is behind the last cell being zero, without
/// ghosts in x; a row of zeros below and one above.
struct KeptPlane {
  explicit constexpr KeptPlane(int cells) noexcept : stride(rows::wholeVectors(cells)), size(stride * (cells + 2)) {}
  [[nodiscard]] constexpr std::ptrdiff_t row(int y) const noexcept { return std::ptrdiff_t{stride} * (y + 1); }

  int stride;  ///< between rows
  int size;
};

/// A plane and its neighbours.
struct PlanesAround {
  const float* below = nullptr;
  const float* here = nullptr;
  const float* above = nullptr;
};

/// What happens as the sweep moves on by one plane, each to another plane, one behind the other. A step that has
/// nothing to do has a null where it would write to. Planes are those of a Layout, or as said.
struct FineStep {
  int cells = 0;
  std::ptrdiff_t stride = 0;  ///< between rows of a Layout

  /// out = x + the correction by the coarser level's `coarse`, unless that is null.
  struct Correct {
    const float* x = nullptr;
    float* out = nullptr;
    rows::FineOperator a{};
    const float* coarse = nullptr;  ///< the coarse plane that holds this one
    rows::CoarseOperator weights{};
    bool highZ = false;  ///< whether it is the upper one of the two in there
  } correct;

  /// source (kept) = b - A x; smoothed = the first stage of the smoother, from zero.
  struct Residual {
    rows::FineOperator a{};
    const float* b = nullptr;
    PlanesAround x;
    float* source = nullptr;
    float* smoothed = nullptr;
  } residual;

  /// A stage of the smoother, which replaces the iterate before the current one, in `out`, by the next. All planes are
  /// kept ones. The first is not used.
  struct Smooth {
    const std::uint8_t* sixtieths = nullptr;
    const float* source = nullptr;
    PlanesAround error;
    float* out = nullptr;
  };
  std::array<Smooth, kFineStages> smooth;

  /// out += error (kept).
  struct Add {
    const float* error = nullptr;
    float* out = nullptr;
  } add;

  /// out = source - A error, all kept.
  struct Left {
    rows::FineOperator a{};
    const float* source = nullptr;
    PlanesAround error;
    float* out = nullptr;
  } left;
};

/// Squared sums over the planes of a step.
struct FineSums {
  double residual = 0.0;
  double b = 0.0;
  double left = 0.0;
};
FineSums runFineStep(const FineStep& step);

/// The right-hand side of a coarse plane from what is left of the residual on the fine planes 2K-1..2K+2 (kept).
struct RestrictedPlane {
  std::array<const float*, 4> left{};
  int keptStride = 0;
  rows::CoarseOperator weights{};
  float* out = nullptr;
  std::ptrdiff_t stride = 0;  ///< between coarse rows
  int cells = 0;              ///< coarse ones
};
void restrictFine(const RestrictedPlane& plane);

}  // namespace grove::objects::fluid
