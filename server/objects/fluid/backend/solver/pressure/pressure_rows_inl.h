// The inner loops of the multigrid, one row of cells at a time, in whole vectors. For kernels: included once per
// target.

#if defined(GROVE_OBJECTS_FLUID_BACKEND_SOLVER_PRESSURE_PRESSURE_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_FLUID_BACKEND_SOLVER_PRESSURE_PRESSURE_ROWS_INL_H
#undef GROVE_OBJECTS_FLUID_BACKEND_SOLVER_PRESSURE_PRESSURE_ROWS_INL_H
#else
#define GROVE_OBJECTS_FLUID_BACKEND_SOLVER_PRESSURE_PRESSURE_ROWS_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "objects/fluid/backend/solver/pressure/pressure_operator.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::rows::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = simd::HWY_NAMESPACE;

using lanes::Floats;
using lanes::kLanes;
using lanes::load;
using lanes::Mask;
using lanes::mulAdd;
using lanes::onlyWhere;
using lanes::store;

/// A row of the unknown, and the same row of the planes below and above.
struct Around3 {
  const float* below;
  const float* here;
  const float* above;
};

HWY_INLINE Around3 around(const float* here, std::ptrdiff_t p) { return {here - p, here, here + p}; }

HWY_INLINE Floats loadBytes(const std::uint8_t* from) {
  const hn::Rebind<std::uint8_t, lanes::IntTag> bytes;
  return hn::ConvertTo(lanes::FloatTag(), hn::PromoteTo(lanes::IntTag(), hn::LoadU(bytes, from)));
}

HWY_INLINE Floats neighbours(const FineOperator& a, const Around3& v, std::ptrdiff_t i) {
  return ((load(v.here + i - 1) + load(v.here + i + 1)) + (load(v.here + i - a.s) + load(v.here + i + a.s))) +
         (load(v.below + i) + load(v.above + i));
}
HWY_INLINE Floats neighbours(const CoarseOperator& a, const Around3& v, std::ptrdiff_t i) {
  const Floats x = mulAdd(load(a.x + i), load(v.here + i - 1), load(a.x + i + 1) * load(v.here + i + 1));
  const Floats y = mulAdd(load(a.y + i), load(v.here + i - a.s), load(a.y + i + a.s) * load(v.here + i + a.s));
  const Floats z = mulAdd(load(a.z + i), load(v.below + i), load(a.z + i + a.p) * load(v.above + i));
  return (x + y) + z;
}

HWY_INLINE Floats weight(const FineOperator& a, std::ptrdiff_t i) { return loadBytes(a.diagonal + i); }
HWY_INLINE Floats weight(const CoarseOperator& a, std::ptrdiff_t i) { return load(a.diagonal + i); }

HWY_INLINE Floats inverse(const FineOperator& a, std::ptrdiff_t i) {
  return loadBytes(a.sixtieths + i) * Floats(1.0F / static_cast<float>(FineOperator::kSixty));
}
HWY_INLINE Floats inverse(const CoarseOperator& a, std::ptrdiff_t i) { return load(a.inverseDiagonal + i); }

/// First stage from a zero guess.
template <class Operator>
HWY_INLINE void smoothFromZero(const Operator& a, const ChebyshevStage& stage, const float* b, float* out, int n) {
  const Floats jacobi(stage.jacobi);
  for (int i = 0; i < n; i += kLanes) store(jacobi * load(b + i) * inverse(a, i), out + i);
}

/// A stage without a previous iterate.
template <class Operator>
HWY_INLINE void smoothFirst(const Operator& a, const ChebyshevStage& stage, const float* b, const Around3& z,
                            float* out, int n) {
  const Floats own(stage.own);
  const Floats jacobi(stage.jacobi);
  for (int i = 0; i < n; i += kLanes) {
    const Floats step = jacobi * inverse(a, i) * (load(b + i) + neighbours(a, z, i));
    store(mulAdd(own, load(z.here + i), step), out + i);
  }
}

/// A stage that replaces the previous iterate, in `out`, by the next one.
template <class Operator>
HWY_INLINE void smooth(const Operator& a, const ChebyshevStage& stage, const float* b, const Around3& z, float* out,
                       int n) {
  const Floats own(stage.own);
  const Floats previous(stage.previous);
  const Floats jacobi(stage.jacobi);
  for (int i = 0; i < n; i += kLanes) {
    const Floats step = jacobi * inverse(a, i) * (load(b + i) + neighbours(a, z, i));
    store(mulAdd(own, load(z.here + i), mulAdd(previous, load(out + i), step)), out + i);
  }
}

/// out = b - A z; zero in solids.
template <class Operator>
HWY_INLINE Floats residualAt(const Operator& a, const float* b, const Around3& z, std::ptrdiff_t i) {
  const Floats d = weight(a, i);
  return onlyWhere(d > Floats(0.0F), (load(b + i) + neighbours(a, z, i)) - d * load(z.here + i));
}
template <class Operator>
HWY_INLINE void residual(const Operator& a, const float* b, const Around3& z, float* out, int n) {
  for (int i = 0; i < n; i += kLanes) store(residualAt(a, b, z, i), out + i);
}

/// out = A z; also adds to r.z and z.Az.
template <class Operator>
HWY_INLINE void applyOperator(const Operator& a, const float* r, const Around3& z, float* out, int n, Floats& rz,
                              Floats& zaz) {
  for (int i = 0; i < n; i += kLanes) {
    const Floats d = weight(a, i);
    const Floats here = load(z.here + i);
    const Floats az = onlyWhere(d > Floats(0.0F), d * here - neighbours(a, z, i));
    store(az, out + i);
    rz = mulAdd(load(r + i), here, rz);
    zaz = mulAdd(az, here, zaz);
  }
}

/// Interpolates a coarse row linearly to the fine row on its (highY, highZ) side: out = z + result in air cells.
/// `weights` point to the coarse row, `fine` to the fine row.
template <class Operator>
HWY_INLINE void interpolate(const float* coarse, const CoarseOperator& weights, bool highY, bool highZ,
                            const Operator& fine, const float* z, float* out, int coarseCells) {
  const std::ptrdiff_t toY = highY ? weights.s : -weights.s;
  const std::ptrdiff_t toZ = highZ ? weights.p : -weights.p;
  const float* wy = weights.y + (highY ? weights.s : 0);
  const float* wz = weights.z + (highZ ? weights.p : 0);
  const float* wx = weights.x;
  const Floats quarter(0.25F);
  alignas(64) float correction[kLongestRow + 2 * kLanes];
  for (int i = 0; i < coarseCells; i += kLanes) {
    const Floats c = load(coarse + i);
    const Floats y = load(wy + i) * (load(coarse + i + toY) - c);
    const Floats base = mulAdd(quarter, mulAdd(load(wz + i), load(coarse + i + toZ) - c, y), c);
    const Floats low = mulAdd(quarter * load(wx + i), load(coarse + i - 1) - c, base);
    const Floats high = mulAdd(quarter * load(wx + i + 1), load(coarse + i + 1) - c, base);
    hn::StoreInterleaved2(low.raw, high.raw, lanes::FloatTag(), correction + 2 * static_cast<std::ptrdiff_t>(i));
  }
  for (int i = 0; i < 2 * coarseCells; i += kLanes) {
    store(load(z + i) + onlyWhere(weight(fine, i) > Floats(0.0F), load(correction + i)), out + i);
  }
}

/// Rows around a coarse row: row[z][y] for the fine rows 2J-1..2J+2 of the fine planes 2K-1..2K+2.
struct Around {
  const float* row[4][4];
};

/// Sums over a coarse row's four fine rows, at even and odd x, and over the rows across its four sides.
struct SumsOfRows {
  static constexpr int kLead = 16;
  static constexpr int kRoom = kLongestRow / 2 + 2 * kLead;
  alignas(64) float even[kRoom];
  alignas(64) float odd[kRoom];
  alignas(64) float acrossY[kRoom];
  alignas(64) float acrossZ[kRoom];
};

HWY_INLINE void sumRows(const Around& fine, const CoarseOperator& weights, int coarseCells, SumsOfRows& sums) {
  const lanes::FloatTag tag;
  const auto& r = fine.row;
  for (int i = 0; i < coarseCells; i += kLanes) {
    const std::ptrdiff_t at = 2 * static_cast<std::ptrdiff_t>(i);
    const auto pair = [&](const float* row, Floats& first, Floats& second) HWY_ATTR {
      const Floats low = load(row + at);
      const Floats high = load(row + at + kLanes);
      first = hn::ConcatEven(tag, high.raw, low.raw);
      second = hn::ConcatOdd(tag, high.raw, low.raw);
    };
    const auto total = [&](const float* row, const float* other) HWY_ATTR {
      const Floats low = load(row + at) + load(other + at);
      const Floats high = load(row + at + kLanes) + load(other + at + kLanes);
      return Floats(hn::ConcatEven(tag, high.raw, low.raw)) + Floats(hn::ConcatOdd(tag, high.raw, low.raw));
    };
    Floats evens[4];
    Floats odds[4];
    pair(r[1][1], evens[0], odds[0]);
    pair(r[1][2], evens[1], odds[1]);
    pair(r[2][1], evens[2], odds[2]);
    pair(r[2][2], evens[3], odds[3]);
    store((evens[0] + evens[1]) + (evens[2] + evens[3]), sums.even + SumsOfRows::kLead + i);
    store((odds[0] + odds[1]) + (odds[2] + odds[3]), sums.odd + SumsOfRows::kLead + i);
    Floats own[4];
    for (int k = 0; k < 4; ++k) own[k] = evens[k] + odds[k];
    const Floats lowY = total(r[1][0], r[2][0]) - (own[0] + own[2]);
    const Floats highY = total(r[1][3], r[2][3]) - (own[1] + own[3]);
    const Floats lowZ = total(r[0][1], r[0][2]) - (own[0] + own[1]);
    const Floats highZ = total(r[3][1], r[3][2]) - (own[2] + own[3]);
    store(mulAdd(load(weights.y + i), lowY, load(weights.y + i + weights.s) * highY), sums.acrossY + i);
    store(mulAdd(load(weights.z + i), lowZ, load(weights.z + i + weights.p) * highZ), sums.acrossZ + i);
  }
}

/// Transpose of interpolate(). `weights` and `out` point to the coarse row. Fine rows may contain any values beyond
/// their ends.
HWY_INLINE void restrictRow(const Around& fine, const CoarseOperator& weights, float* out, int coarseCells) {
  // 0.5 would be consistent. A tenth more was measured to save one of four iterations amid obstacles; twice that excess
  // is worse again.
  constexpr float kScale = 0.55F;
  SumsOfRows sums;
  sumRows(fine, weights, coarseCells, sums);
  float* const even = sums.even + SumsOfRows::kLead;
  float* const odd = sums.odd + SumsOfRows::kLead;
  odd[-1] = 0.0F;
  even[coarseCells] = 0.0F;
  for (int i = 0; i < coarseCells; i += kLanes) {
    const Floats evens = load(even + i);
    const Floats odds = load(odd + i);
    const Floats x =
        mulAdd(load(weights.x + i), load(odd + i - 1) - evens, load(weights.x + i + 1) * (load(even + i + 1) - odds));
    const Floats across = (x + load(sums.acrossY + i)) + load(sums.acrossZ + i);
    const Floats sum = Floats(kScale) * mulAdd(Floats(0.25F), across, evens + odds);
    store(onlyWhere(load(weights.diagonal + i) > Floats(0.0F), sum), out + i);
  }
}

}  // namespace grove::objects::fluid::rows::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
