#pragma once

#include <cstddef>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/pressure_operator.h"

/// The passes of a V-cycle (Multigrid) over one level, each a sweep over z-planes.
namespace grove::objects::fluid {

/// One level with its kind of operator A. Ghosts and solids of `b` and `z` are zero and stay so.
template <class Operator>
struct MultigridLevel {
  const Layout& layout;
  Operator a;
  const float* b;
  float* z;
  float* odd;       ///< scratch planes for the smoother's first and third iterate; the others are in z
  float* residual;  ///< scratch planes between smoothing and restriction
};
using FineLevel = MultigridLevel<rows::FineOperator>;
using CoarseLevel = MultigridLevel<rows::CoarseOperator>;

/// Sizes of `odd` and `residual` in values, initially zero.
[[nodiscard]] std::size_t multigridRoom(const Layout& layout) noexcept;

/// Down one level: smooths z from zero and restricts the residual to the coarser level's right-hand side `coarseB`.
void descendFine(const FineLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                 float* coarseB);
void descendCoarse(const CoarseLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                   float* coarseB);

/// Dot products z.Az and b.z.
struct MultigridProducts {
  double residualDotResult = 0.0;
  double resultDotOperator = 0.0;
};
/// Up one level: adds the coarse correction to z and smooths. For the finest level also computes A z.
MultigridProducts ascendFine(const FineLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                             const float* coarseZ, float* az);
void ascendCoarse(const CoarseLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                  const float* coarseZ);

/// The coarsest level has so few cells that repeating the smoother solves it.
void smoothCoarsest(const CoarseLevel& level);

}  // namespace grove::objects::fluid
