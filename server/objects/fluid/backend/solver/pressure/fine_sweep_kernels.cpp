#include "objects/fluid/backend/solver/pressure/fine_sweep_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/backend/solver/pressure/fine_sweep_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "objects/fluid/backend/solver/pressure/pressure_rows_inl.h"

#ifndef GROVE_OBJECTS_FLUID_FINE_SWEEP_KERNELS_CPP
#define GROVE_OBJECTS_FLUID_FINE_SWEEP_KERNELS_CPP

namespace grove::objects::fluid {

/// The coarser level handles eigenvalues of Jacobi below this, a little lower than for few stages.
constexpr auto kChebyshev = rows::chebyshevStages<kFineStages>(0.15F);

/// All parts advance through their planes together, a few rows at a time, so that a part's output is still in the
/// nearest cache when the next part reads it. No part reads further rows of a plane that the same step writes.
constexpr int kRowsAtATime = 8;

}  // namespace grove::objects::fluid

#endif

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

namespace pr = rows::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;
using pr::Floats;
using pr::kLanes;
using pr::load;
using pr::loadBytes;
using pr::Mask;
using pr::mulAdd;
using pr::onlyWhere;
using pr::store;

struct RowRange {
  int first;
  int end;
};

/// The sum of the six neighbours, going up a column of rows with the layout of a KeptPlane: each row is loaded once.
class KeptColumn {
 public:
  HWY_INLINE KeptColumn(const PlanesAround& planes, int stride, int x, std::ptrdiff_t at)
      : below_(planes.below),
        row_(planes.here),
        above_(planes.above),
        stride_(stride),
        at_(at),
        inFromLow_(x == 0 ? hn::Not(hn::FirstN(lanes_, 1)) : hn::FirstN(lanes_, kLanes)),
        inFromHigh_(hn::FirstN(lanes_, x + kLanes == stride ? kLanes - 1 : kLanes)),
        south_(load(planes.here + at - stride)),
        here_(load(planes.here + at)),
        north_(load(planes.here + at + stride)) {}

  HWY_INLINE Floats here() const { return here_; }
  HWY_INLINE Floats neighbours() const {
    const Floats west = onlyWhere(inFromLow_, load(row_ + at_ - 1));
    const Floats east = onlyWhere(inFromHigh_, load(row_ + at_ + 1));
    return ((west + east) + (south_ + north_)) + (load(below_ + at_) + load(above_ + at_));
  }
  HWY_INLINE void goUp() {
    at_ += stride_;
    south_ = here_;
    here_ = north_;
    north_ = load(row_ + at_ + stride_);
  }

 private:
  static constexpr pr::lanes::FloatTag lanes_{};
  const float* const below_;  // by value, because a reference could alias the output
  const float* const row_;
  const float* const above_;
  const std::ptrdiff_t stride_;
  std::ptrdiff_t at_;
  const Mask inFromLow_;
  const Mask inFromHigh_;
  Floats south_, here_, north_;
};

HWY_INLINE void correct(const FineStep& step, const RowRange range) {
  const FineStep::Correct& c = step.correct;
  for (int y = range.first; y < range.end; ++y) {
    const std::ptrdiff_t at = step.stride * y;
    if (c.coarse == nullptr) {
      for (int i = 0; i < step.cells; i += kLanes) store(load(c.x + at + i), c.out + at + i);
      continue;
    }
    const std::ptrdiff_t from = c.weights.s * (y / 2);
    pr::interpolate(c.coarse + from, c.weights.from(from), y % 2 != 0, c.highZ, c.a.from(at), c.x + at, c.out + at,
                    step.cells / 2);
  }
}

HWY_INLINE void takeResidual(const FineStep& step, const RowRange range, Floats& squared, Floats& squaredB) {
  const FineStep::Residual p = step.residual;
  const KeptPlane kept(step.cells);
  const Floats jacobi(kChebyshev[0].jacobi);
  for (int y = range.first; y < range.end; ++y) {
    const std::ptrdiff_t at = step.stride * y;
    const std::ptrdiff_t to = std::ptrdiff_t{kept.stride} * y;
    const rows::FineOperator a = p.a.from(at);
    const pr::Around3 x{p.x.below + at, p.x.here + at, p.x.above + at};
    for (int i = 0; i < step.cells; i += kLanes) {
      const Floats b = load(p.b + at + i);
      const Floats r = pr::residualAt(a, p.b + at, x, i);
      squared = mulAdd(r, r, squared);
      squaredB = mulAdd(b, b, squaredB);
      store(r, p.source + to + i);
      store(jacobi * pr::inverse(a, i) * r, p.smoothed + to + i);
    }
  }
}

/// kSecond: there is no previous iterate.
template <bool kSecond>
HWY_INLINE void smooth(const FineStep& step, const rows::ChebyshevStage& stage, const FineStep::Smooth& p,
                       const RowRange range) {
  const KeptPlane kept(step.cells);
  const std::ptrdiff_t byteStride = step.stride;
  const float* const source = p.source;
  float* const out = p.out;
  const Floats own(stage.own);
  const Floats previous(stage.previous);
  const Floats jacobi(stage.jacobi / static_cast<float>(rows::FineOperator::kSixty));
  for (int x = 0; x < kept.stride; x += kLanes) {
    std::ptrdiff_t at = std::ptrdiff_t{kept.stride} * range.first + x;
    const std::uint8_t* sixtieths = p.sixtieths + step.stride * range.first + x;
    KeptColumn error(p.error, kept.stride, x, at);
    for (int y = range.first; y < range.end; ++y) {
      const Floats sum = load(source + at) + error.neighbours();
      Floats next = own * error.here();
      if constexpr (!kSecond) next = mulAdd(previous, load(out + at), next);
      store(mulAdd(jacobi * loadBytes(sixtieths), sum, next), out + at);
      error.goUp();
      at += kept.stride;
      sixtieths += byteStride;
    }
  }
}

HWY_INLINE void add(const FineStep& step, const RowRange range) {
  const KeptPlane kept(step.cells);
  for (int y = range.first; y < range.end; ++y) {
    const float* error = step.add.error + std::ptrdiff_t{kept.stride} * y;
    float* out = step.add.out + step.stride * y;
    for (int i = 0; i < step.cells; i += kLanes) store(load(out + i) + load(error + i), out + i);
  }
}

HWY_INLINE void keepLeft(const FineStep& step, const RowRange range, Floats& squared) {
  const FineStep::Left p = step.left;
  const std::ptrdiff_t byteStride = step.stride;
  const KeptPlane kept(step.cells);
  for (int x = 0; x < kept.stride; x += kLanes) {
    std::ptrdiff_t at = std::ptrdiff_t{kept.stride} * range.first + x;
    const std::uint8_t* diagonal = p.a.diagonal + step.stride * range.first + x;
    KeptColumn error(p.error, kept.stride, x, at);
    for (int y = range.first; y < range.end; ++y) {
      const Floats d = loadBytes(diagonal);
      const Floats r = (load(p.source + at) + error.neighbours()) - d * error.here();
      const Floats left = onlyWhere(d > Floats(0.0F), r);
      squared = mulAdd(left, left, squared);
      store(left, p.out + at);
      error.goUp();
      at += kept.stride;
      diagonal += byteStride;
    }
  }
}

FineSums runFineStep(const FineStep& step) {
  FineSums sums;
  for (int y = 0; y < step.cells; y += kRowsAtATime) {
    const RowRange range{y, std::min(y + kRowsAtATime, step.cells)};
    Floats residual;
    Floats b;
    Floats left;
    if (step.correct.out != nullptr) correct(step, range);
    if (step.residual.source != nullptr) takeResidual(step, range, residual, b);
    if (step.smooth[1].out != nullptr) smooth<true>(step, kChebyshev[1], step.smooth[1], range);
    for (std::size_t k = 2; k < kFineStages; ++k) {
      if (step.smooth[k].out != nullptr) smooth<false>(step, kChebyshev[k], step.smooth[k], range);
    }
    if (step.add.out != nullptr) add(step, range);
    if (step.left.out != nullptr) keepLeft(step, range, left);
    sums.residual += static_cast<double>(pr::lanes::sumOf(residual));
    sums.b += static_cast<double>(pr::lanes::sumOf(b));
    sums.left += static_cast<double>(pr::lanes::sumOf(left));
  }
  return sums;
}

void restrictFine(const RestrictedPlane& plane) {
  for (int y = 0; y < plane.cells; ++y) {
    pr::Around fine{};
    for (int dz = 0; dz < 4; ++dz) {
      for (int dy = 0; dy < 4; ++dy) {
        fine.row[dz][dy] =
            plane.left[static_cast<std::size_t>(dz)] + std::ptrdiff_t{plane.keptStride} * (2 * y - 1 + dy);
      }
    }
    const std::ptrdiff_t at = plane.stride * y;
    pr::restrictRow(fine, plane.weights.from(at), plane.out + at, plane.cells);
  }
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(runFineStep);
HWY_EXPORT(restrictFine);

FineSums runFineStep(const FineStep& step) { return HWY_DYNAMIC_DISPATCH(runFineStep)(step); }

void restrictFine(const RestrictedPlane& plane) { HWY_DYNAMIC_DISPATCH(restrictFine)(plane); }

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
