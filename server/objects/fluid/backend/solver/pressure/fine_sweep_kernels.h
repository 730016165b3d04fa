#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "objects/fluid/backend/solver/pressure/pressure_operator.h"

/// FineSweep's work on one plane at a time. Pointers are to the first cell of a plane's row 0.
namespace grove::objects::fluid {

/// Stages of the finest level's smoother: a Chebyshev polynomial of Jacobi.
inline constexpr int kFineStages = 10;

/// Layout of the planes that the sweep keeps ("kept planes"): rows of whole vectors, zero beyond the last cell, without
/// ghosts in x; one row of zeros below and one above.
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

/// The work of one step of the sweep. Each part works on another plane, one behind the other. A part without work has a
/// null output. Planes have the strides of a Layout unless stated otherwise.
struct FineStep {
  int cells = 0;
  std::ptrdiff_t stride = 0;  ///< between rows of a Layout

  /// out = x + the interpolated correction of the coarser level's `coarse`, unless that is null.
  struct Correct {
    const float* x = nullptr;
    float* out = nullptr;
    rows::FineOperator a{};
    const float* coarse = nullptr;  ///< the coarse plane that contains this one
    rows::CoarseOperator weights{};
    bool highZ = false;  ///< whether this is the upper one of the coarse plane's two fine planes
  } correct;

  /// source (kept) = b - A x; smoothed = the first stage of the smoother, from zero.
  struct Residual {
    rows::FineOperator a{};
    const float* b = nullptr;
    PlanesAround x;
    float* source = nullptr;
    float* smoothed = nullptr;
  } residual;

  /// A stage of the smoother. Replaces the previous iterate, in `out`, by the next one. All planes are kept planes. The
  /// first entry is unused.
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

  /// out = source - A error, all kept planes.
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

/// Computes a coarse plane's right-hand side from the remaining residual on the fine planes 2K-1..2K+2 (kept planes).
struct RestrictedPlane {
  std::array<const float*, 4> left{};
  int keptStride = 0;
  rows::CoarseOperator weights{};
  float* out = nullptr;
  std::ptrdiff_t stride = 0;  ///< between coarse rows
  int cells = 0;              ///< coarse cells per edge
};
void restrictFine(const RestrictedPlane& plane);

}  // namespace grove::objects::fluid
