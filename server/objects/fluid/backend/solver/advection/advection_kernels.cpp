#include "objects/fluid/backend/solver/advection/advection_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/backend/solver/advection/advection_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "base/simd/loops.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = simd::HWY_NAMESPACE;

using FullTag = lanes::FloatTag;
/// Smaller vectors for the ends of rows, so that a row of 65 faces does not cost as much as one of 80.
using EndTag = hn::CappedTag<float, 4>;

/// The eight values around i - move. Names: h = here, o = the other one in the direction of the move; axes in the order
/// x, y, z.
template <class V>
struct Corners {
  V hhh, ohh, hoh, ooh, hho, oho, hoo, ooo;
};

template <class V>
HWY_INLINE V mix(V from, V to, V share) {
  return hn::MulAdd(share, hn::Sub(to, from), from);
}

template <class V>
HWY_INLINE V mix(const Corners<V>& c, V fx, V fy, V fz) {
  const V h = mix(mix(c.hhh, c.ohh, fx), mix(c.hoh, c.ooh, fx), fy);
  const V o = mix(mix(c.hho, c.oho, fx), mix(c.hoo, c.ooo, fx), fy);
  return mix(h, o, fz);
}

/// Location of the other values: below (x - 1, y - 1 or z - 1) in the lanes of a mask, else above.
template <class D>
struct OtherSides {
  hn::Mask<D> isBelowX, isBelowY, isBelowZ;
  std::ptrdiff_t x, y;  ///< offset of the other value, where all lanes agree
  std::ptrdiff_t stride;
};

template <bool kMixedX, class D>
HWY_INLINE hn::Vec<D> otherX(D d, const OtherSides<D>& sides, const float* at) {
  if constexpr (kMixedX) return hn::IfThenElse(sides.isBelowX, hn::LoadU(d, at - 1), hn::LoadU(d, at + 1));
  return hn::LoadU(d, at + sides.x);
}

template <bool kMixedY, class D>
HWY_INLINE hn::Vec<D> otherY(D d, const OtherSides<D>& sides, const float* at) {
  if constexpr (kMixedY) {
    return hn::IfThenElse(sides.isBelowY, hn::LoadU(d, at - sides.stride), hn::LoadU(d, at + sides.stride));
  }
  return hn::LoadU(d, at + sides.y);
}

template <bool kMixedX, bool kMixedY, class D>
HWY_INLINE hn::Vec<D> otherXY(D d, const OtherSides<D>& sides, const float* at) {
  if constexpr (kMixedY) {
    return hn::IfThenElse(sides.isBelowY, otherX<kMixedX>(d, sides, at - sides.stride),
                          otherX<kMixedX>(d, sides, at + sides.stride));
  }
  return otherX<kMixedX>(d, sides, at + sides.y);
}

/// In most vectors all lanes move the same way along an axis; then one load replaces two and a select.
template <bool kMixedX, bool kMixedY, bool kMixedZ, class D>
HWY_INLINE Corners<hn::Vec<D>> cornersAlong(D d, const OtherSides<D>& sides, const float* below, const float* here,
                                            const float* above, const float* other) {
  Corners<hn::Vec<D>> c;
  c.hhh = hn::LoadU(d, here);
  c.ohh = otherX<kMixedX>(d, sides, here);
  c.hoh = otherY<kMixedY>(d, sides, here);
  c.ooh = otherXY<kMixedX, kMixedY>(d, sides, here);
  if constexpr (kMixedZ) {
    const hn::Mask<D> isBelow = sides.isBelowZ;
    c.hho = hn::IfThenElse(isBelow, hn::LoadU(d, below), hn::LoadU(d, above));
    c.oho = hn::IfThenElse(isBelow, otherX<kMixedX>(d, sides, below), otherX<kMixedX>(d, sides, above));
    c.hoo = hn::IfThenElse(isBelow, otherY<kMixedY>(d, sides, below), otherY<kMixedY>(d, sides, above));
    c.ooo =
        hn::IfThenElse(isBelow, otherXY<kMixedX, kMixedY>(d, sides, below), otherXY<kMixedX, kMixedY>(d, sides, above));
  } else {
    c.hho = hn::LoadU(d, other);
    c.oho = otherX<kMixedX>(d, sides, other);
    c.hoo = otherY<kMixedY>(d, sides, other);
    c.ooo = otherXY<kMixedX, kMixedY>(d, sides, other);
  }
  return c;
}

template <class D, class V>
HWY_INLINE Corners<V> cornersAt(D d, const SampledPlanes& planes, std::ptrdiff_t stride, std::ptrdiff_t at, V dx, V dy,
                                V dz) {
  const V zero = hn::Zero(d);
  const OtherSides<D> mixed{hn::Gt(dx, zero), hn::Gt(dy, zero), hn::Gt(dz, zero), 0, 0, stride};
  const bool lowX = hn::AllTrue(d, mixed.isBelowX);
  const bool lowY = hn::AllTrue(d, mixed.isBelowY);
  const bool lowZ = hn::AllTrue(d, mixed.isBelowZ);
  const int mixedX = lowX || hn::AllFalse(d, mixed.isBelowX) ? 0 : 1;
  const int mixedY = lowY || hn::AllFalse(d, mixed.isBelowY) ? 0 : 2;
  const int mixedZ = lowZ || hn::AllFalse(d, mixed.isBelowZ) ? 0 : 4;
  const OtherSides<D> w{mixed.isBelowX, mixed.isBelowY, mixed.isBelowZ, lowX ? -1 : 1, lowY ? -stride : stride, stride};
  const float* below = planes.below + at;
  const float* here = planes.here + at;
  const float* above = planes.above + at;
  const float* other = lowZ ? below : above;
  switch (mixedX + mixedY + mixedZ) {
    case 0:
      return cornersAlong<false, false, false>(d, w, below, here, above, other);
    case 1:
      return cornersAlong<true, false, false>(d, w, below, here, above, other);
    case 2:
      return cornersAlong<false, true, false>(d, w, below, here, above, other);
    case 3:
      return cornersAlong<true, true, false>(d, w, below, here, above, other);
    case 4:
      return cornersAlong<false, false, true>(d, w, below, here, above, other);
    case 5:
      return cornersAlong<true, false, true>(d, w, below, here, above, other);
    case 6:
      return cornersAlong<false, true, true>(d, w, below, here, above, other);
    default:
      return cornersAlong<true, true, true>(d, w, below, here, above, other);
  }
}

template <class D>
HWY_INLINE void sampleAt(D d, std::ptrdiff_t at, std::ptrdiff_t stride, const SampledPlanes& planes, const Moves& moves,
                         const Samples& samples) {
  using V = hn::Vec<D>;
  const V scale = hn::Set(d, moves.scale);
  const V dx = hn::Mul(scale, hn::LoadU(d, moves.x + at));
  const V dy = hn::Mul(scale, hn::LoadU(d, moves.y + at));
  const V dz = hn::Mul(scale, hn::LoadU(d, moves.z + at));
  const Corners<V> c = cornersAt(d, planes, stride, at, dx, dy, dz);
  hn::StoreU(mix(c, hn::Abs(dx), hn::Abs(dy), hn::Abs(dz)), d, samples.value + at);
  const V lowH = hn::Min(hn::Min(c.hhh, c.ohh), hn::Min(c.hoh, c.ooh));
  const V lowO = hn::Min(hn::Min(c.hho, c.oho), hn::Min(c.hoo, c.ooo));
  hn::StoreU(hn::Min(lowH, lowO), d, samples.low + at);
  const V highH = hn::Max(hn::Max(c.hhh, c.ohh), hn::Max(c.hoh, c.ooh));
  const V highO = hn::Max(hn::Max(c.hho, c.oho), hn::Max(c.hoo, c.ooo));
  hn::StoreU(hn::Max(highH, highO), d, samples.high + at);
}

/// `out` points to the first of the values.
template <class D>
HWY_INLINE void correctAt(D d, std::ptrdiff_t at, std::ptrdiff_t stride, const SampledPlanes& forth, const Moves& moves,
                          const float* in, const float* low, const float* high, float* out) {
  using V = hn::Vec<D>;
  const V scale = hn::Set(d, -moves.scale);
  const V dx = hn::Mul(scale, hn::LoadU(d, moves.x + at));
  const V dy = hn::Mul(scale, hn::LoadU(d, moves.y + at));
  const V dz = hn::Mul(scale, hn::LoadU(d, moves.z + at));
  const Corners<V> c = cornersAt(d, forth, stride, at, dx, dy, dz);
  const V back = mix(c, hn::Abs(dx), hn::Abs(dy), hn::Abs(dz));
  const V better = hn::MulAdd(hn::Set(d, 0.5F), hn::Sub(hn::LoadU(d, in + at), back), c.hhh);
  hn::StoreU(hn::Min(hn::Max(better, hn::LoadU(d, low + at)), hn::LoadU(d, high + at)), d, out);
}

void sampleNear(const PlaneExtent& extent, const SampledPlanes& planes, const Moves& moves, const Samples& samples) {
  const FullTag full;
  const EndTag end;
  const int whole = extent.columns - extent.columns % lanes::kLanes;
  for (int y = extent.firstRow; y < extent.endRow; ++y) {
    const std::ptrdiff_t row = extent.stride * y;
    int i = 0;
    for (; i < whole; i += lanes::kLanes) sampleAt(full, row + i, extent.stride, planes, moves, samples);
    for (; i < extent.columns; i += static_cast<int>(hn::MaxLanes(end))) {
      sampleAt(end, row + i, extent.stride, planes, moves, samples);
    }
  }
}

void correctSamples(const PlaneExtent& extent, const SampledPlanes& forth, const Moves& moves, const float* in,
                    const float* low, const float* high, float* out) {
  const FullTag full;
  const EndTag end;
  constexpr int kEnd = static_cast<int>(hn::MaxLanes(EndTag()));
  const int whole = extent.columns - extent.columns % lanes::kLanes;
  for (int y = extent.firstRow; y < extent.endRow; ++y) {
    const std::ptrdiff_t row = extent.stride * y;
    int i = 0;
    for (; i < whole; i += lanes::kLanes) {
      correctAt(full, row + i, extent.stride, forth, moves, in, low, high, out + row + i);
    }
    for (; i < extent.columns; i += kEnd) {
      alignas(16) float values[kEnd];
      correctAt(end, row + i, extent.stride, forth, moves, in, low, high, values);
      for (int k = 0; k < kEnd && i + k < extent.columns; ++k) out[row + i + k] = values[k];
    }
  }
}

void meanOfFour(const PlaneExtent& extent, const float* a, const float* b, const float* c, const float* d, float* out) {
  for (int y = extent.firstRow; y < extent.endRow; ++y) {
    const std::ptrdiff_t row = extent.stride * y;
    GROVE_INDEPENDENT_ITERATIONS
    for (std::ptrdiff_t i = row; i < row + extent.columns; ++i) out[i] = 0.25F * ((a[i] + b[i]) + (c[i] + d[i]));
  }
}

void meanOfTwo(const PlaneExtent& extent, const float* a, const float* b, float* out) {
  for (int y = extent.firstRow; y < extent.endRow; ++y) {
    const std::ptrdiff_t row = extent.stride * y;
    GROVE_INDEPENDENT_ITERATIONS
    for (std::ptrdiff_t i = row; i < row + extent.columns; ++i) out[i] = 0.5F * (a[i] + b[i]);
  }
}

float longestMove(const PlaneExtent& extent, const Moves& moves) {
  float longest = 0.0F;
  for (int y = extent.firstRow; y < extent.endRow; ++y) {
    const std::ptrdiff_t row = extent.stride * y;
    for (std::ptrdiff_t i = row; i < row + extent.columns; ++i) {
      const float x = moves.x[i] < 0.0F ? -moves.x[i] : moves.x[i];
      const float up = moves.y[i] < 0.0F ? -moves.y[i] : moves.y[i];
      const float z = moves.z[i] < 0.0F ? -moves.z[i] : moves.z[i];
      const float max = x > up ? x : up;
      const float any = max > z ? max : z;
      longest = any > longest ? any : longest;
    }
  }
  return longest * moves.scale;
}

RowRange filledRows(const PlaneExtent& extent, const float* values) {
  RowRange range{extent.endRow, extent.firstRow - 1};
  for (int y = extent.firstRow; y < extent.endRow; ++y) {
    const float* row = values + extent.stride * y;
    // Counts, because a search with an early exit does not vectorise.
    int some = 0;
    for (int i = 0; i < extent.columns; ++i) some |= row[i] != 0.0F ? 1 : 0;
    if (some != 0) range = {y < range.first ? y : range.first, y + 1};
  }
  return range;
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(meanOfFour);
HWY_EXPORT(meanOfTwo);
HWY_EXPORT(longestMove);
HWY_EXPORT(sampleNear);
HWY_EXPORT(correctSamples);
HWY_EXPORT(filledRows);

void meanOfFour(const PlaneExtent& extent, const float* a, const float* b, const float* c, const float* d, float* out) {
  HWY_DYNAMIC_DISPATCH(meanOfFour)(extent, a, b, c, d, out);
}

void meanOfTwo(const PlaneExtent& extent, const float* a, const float* b, float* out) {
  HWY_DYNAMIC_DISPATCH(meanOfTwo)(extent, a, b, out);
}

float longestMove(const PlaneExtent& extent, const Moves& moves) {
  return HWY_DYNAMIC_DISPATCH(longestMove)(extent, moves);
}

void sampleNear(const PlaneExtent& extent, const SampledPlanes& planes, const Moves& moves, const Samples& samples) {
  HWY_DYNAMIC_DISPATCH(sampleNear)(extent, planes, moves, samples);
}

void correctSamples(const PlaneExtent& extent, const SampledPlanes& forth, const Moves& moves, const float* in,
                    const float* low, const float* high, float* out) {
  HWY_DYNAMIC_DISPATCH(correctSamples)(extent, forth, moves, in, low, high, out);
}

RowRange filledRows(const PlaneExtent& extent, const float* values) {
  return HWY_DYNAMIC_DISPATCH(filledRows)(extent, values);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
