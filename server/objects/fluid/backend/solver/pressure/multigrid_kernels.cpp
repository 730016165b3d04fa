#include "objects/fluid/backend/solver/pressure/multigrid_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/backend/solver/pressure/multigrid_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "objects/fluid/backend/solver/pressure/pressure_rows_inl.h"

#ifndef GROVE_OBJECTS_FLUID_MULTIGRID_KERNELS_CPP
#define GROVE_OBJECTS_FLUID_MULTIGRID_KERNELS_CPP

namespace grove::objects::fluid {

constexpr int kStages = 4;  // of the smoother; even, so that the last one writes where the first one read
constexpr int kCoarsestSweeps = 6;
constexpr auto kChebyshev = rows::chebyshevStages<kStages>(0.2F);
constexpr int kRingPlanes = 8;
static_assert(kRingPlanes > kStages + 1);

}  // namespace grove::objects::fluid

#endif

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

namespace pr = rows::HWY_NAMESPACE;

/// Planes around the sweep of a temporary field; planes outside the cube are zero.
struct Ring {
  const Layout& layout;
  float* memory;

  HWY_INLINE float* row(int y, int z) const {
    const int slot = z < 0 || z >= layout.cells ? kRingPlanes : z % kRingPlanes;
    return memory + Layout::kLead + std::ptrdiff_t{layout.plane} * slot + std::ptrdiff_t{layout.stride} * (y + 1);
  }
  HWY_INLINE pr::Around3 around(int y, int z) const { return {row(y, z - 1), row(y, z), row(y, z + 1)}; }
};

/// Applies stage `k` (from 0) of the smoother to a plane.
template <class Operator>
HWY_INLINE void smoothPlane(const MultigridLevel<Operator>& level, int k, int plane, bool fromZero) {
  const Layout& layout = level.layout;
  const rows::ChebyshevStage& stage = kChebyshev[static_cast<std::size_t>(k)];
  const Ring odd{layout, level.odd};
  const bool toOdd = k % 2 == 0;
  for (int y = 0; y < layout.cells; ++y) {
    const std::ptrdiff_t at = layout.index(0, y, plane);
    float* const out = toOdd ? odd.row(y, plane) : level.z + at;
    const pr::Around3 in = toOdd ? pr::around(level.z + at, layout.plane) : odd.around(y, plane);
    if (k == 0 && fromZero) {
      pr::smoothFromZero(level.a.from(at), stage, level.b + at, out, layout.cells);
    } else if (k == 0 || (k == 1 && fromZero)) {
      pr::smoothFirst(level.a.from(at), stage, level.b + at, in, out, layout.cells);
    } else {
      pr::smooth(level.a.from(at), stage, level.b + at, in, out, layout.cells);
    }
  }
}

/// Each stage follows one plane behind the previous one, while its planes are in the cache.
template <class Operator>
HWY_INLINE void descend(const MultigridLevel<Operator>& level, const Layout& coarseLayout,
                        const rows::CoarseOperator& coarse, float* coarseB) {
  const Layout& layout = level.layout;
  const Ring residual{layout, level.residual};
  const int n = layout.cells;
  for (int sweep = 0; sweep < n + kStages + 1; ++sweep) {
    for (int k = 0; k < kStages; ++k) {
      if (const int plane = sweep - k; plane >= 0 && plane < n) smoothPlane(level, k, plane, true);
    }
    const int plane = sweep - kStages;
    if (plane < 0) continue;
    for (int y = 0; y < n && plane < n; ++y) {
      const std::ptrdiff_t at = layout.index(0, y, plane);
      pr::residual(level.a.from(at), level.b + at, pr::around(level.z + at, layout.plane), residual.row(y, plane), n);
    }
    if (plane < 2 || plane % 2 != 0) continue;
    const int coarseZ = plane / 2 - 1;
    for (int y = 0; y < coarseLayout.cells; ++y) {
      pr::Around fine{};
      for (int dz = 0; dz < 4; ++dz) {
        for (int dy = 0; dy < 4; ++dy) fine.row[dz][dy] = residual.row(2 * y - 1 + dy, 2 * coarseZ - 1 + dz);
      }
      const std::ptrdiff_t at = coarseLayout.index(0, y, coarseZ);
      pr::restrictRow(fine, coarse.from(at), coarseB + at, coarseLayout.cells);
    }
  }
}

/// Calls `finish` for each plane after it and its neighbours are done.
template <class Operator, class Finish>
HWY_INLINE void ascend(const MultigridLevel<Operator>& level, const Layout& coarseLayout,
                       const rows::CoarseOperator& coarse, const float* coarseZ, const Finish& finish) {
  const Layout& layout = level.layout;
  const int n = layout.cells;
  for (int sweep = 0; sweep < n + kStages + 1; ++sweep) {
    for (int y = 0; y < n && sweep < n; ++y) {
      const std::ptrdiff_t at = layout.index(0, y, sweep);
      const std::ptrdiff_t from = coarseLayout.index(0, y / 2, sweep / 2);
      pr::interpolate(coarseZ + from, coarse.from(from), y % 2 != 0, sweep % 2 != 0, level.a.from(at), level.z + at,
                      level.z + at, coarseLayout.cells);
    }
    for (int k = 0; k < kStages; ++k) {
      if (const int plane = sweep - 1 - k; plane >= 0 && plane < n) smoothPlane(level, k, plane, false);
    }
    if (const int plane = sweep - kStages - 1; plane >= 0) finish(plane);
  }
}

void descendFine(const FineLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                 float* coarseB) {
  descend(level, coarseLayout, coarse, coarseB);
}

void descendCoarse(const CoarseLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                   float* coarseB) {
  descend(level, coarseLayout, coarse, coarseB);
}

MultigridProducts ascendFine(const FineLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                             const float* coarseZ, float* az) {
  MultigridProducts products;
  const Layout& layout = level.layout;
  const auto finish = [&](int plane) HWY_ATTR {
    pr::Floats bz;
    pr::Floats zaz;
    for (int y = 0; y < layout.cells; ++y) {
      const std::ptrdiff_t at = layout.index(0, y, plane);
      pr::applyOperator(level.a.from(at), level.b + at, pr::around(level.z + at, layout.plane), az + at, layout.cells,
                        bz, zaz);
    }
    products.residualDotResult += static_cast<double>(pr::lanes::sumOf(bz));
    products.resultDotOperator += static_cast<double>(pr::lanes::sumOf(zaz));
  };
  ascend(level, coarseLayout, coarse, coarseZ, finish);
  return products;
}

void ascendCoarse(const CoarseLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                  const float* coarseZ) {
  ascend(level, coarseLayout, coarse, coarseZ, [](int) {});
}

void smoothCoarsest(const CoarseLevel& level) {
  for (int i = 0; i < kCoarsestSweeps; ++i) {
    for (int k = 0; k < kStages; ++k) {
      for (int plane = 0; plane < level.layout.cells; ++plane) smoothPlane(level, k, plane, i == 0);
    }
  }
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(descendFine);
HWY_EXPORT(descendCoarse);
HWY_EXPORT(ascendFine);
HWY_EXPORT(ascendCoarse);
HWY_EXPORT(smoothCoarsest);

std::size_t multigridRoom(const Layout& layout) noexcept {
  return static_cast<std::size_t>(2 * Layout::kLead + layout.plane * (kRingPlanes + 1));
}

void descendFine(const FineLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                 float* coarseB) {
  HWY_DYNAMIC_DISPATCH(descendFine)(level, coarseLayout, coarse, coarseB);
}

void descendCoarse(const CoarseLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                   float* coarseB) {
  HWY_DYNAMIC_DISPATCH(descendCoarse)(level, coarseLayout, coarse, coarseB);
}

MultigridProducts ascendFine(const FineLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                             const float* coarseZ, float* az) {
  return HWY_DYNAMIC_DISPATCH(ascendFine)(level, coarseLayout, coarse, coarseZ, az);
}

void ascendCoarse(const CoarseLevel& level, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
                  const float* coarseZ) {
  HWY_DYNAMIC_DISPATCH(ascendCoarse)(level, coarseLayout, coarse, coarseZ);
}

void smoothCoarsest(const CoarseLevel& level) { HWY_DYNAMIC_DISPATCH(smoothCoarsest)(level); }

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
