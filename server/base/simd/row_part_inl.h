// Look-ups of values that are near each other in memory: loads whole rows, then permutes registers. For kernels:
// included once per target.

#if defined(GROVE_BASE_SIMD_ROW_PART_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BASE_SIMD_ROW_PART_INL_H
#undef GROVE_BASE_SIMD_ROW_PART_INL_H
#else
#define GROVE_BASE_SIMD_ROW_PART_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "base/simd/look_up_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::simd::HWY_NAMESPACE {

// Whether permuting two registers takes less time than one load for each lane.
#undef GROVE_SIMD_PERMUTES
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
#define GROVE_SIMD_PERMUTES 1
#else
#define GROVE_SIMD_PERMUTES 0
#endif

#if GROVE_SIMD_PERMUTES
/// 2 kLanes values of a row.
template <class Tag>
struct RowPart {
  hn::Vec<Tag> low;
  hn::Vec<Tag> high;

  HWY_INLINE RowPart(hn::Vec<Tag> first, hn::Vec<Tag> second) : low(first), high(second) {}
  HWY_INLINE explicit RowPart(const hn::TFromD<Tag>* from)
      : RowPart(hn::LoadU(Tag(), from), hn::LoadU(Tag(), from + kLanes)) {}

  /// For each lane, the value at `place`, from 0 to 2 kLanes - 1.
  HWY_INLINE hn::Vec<Tag> at(Ints place) const {
#if HWY_TARGET == HWY_AVX3
    // One instruction, which Highway 1.0 has no name for.
    const auto whole = [](hn::Vec<Tag> value) { return hn::BitCast(IntTag(), value).raw; };
    return hn::BitCast(Tag(), hn::Vec<IntTag>{_mm512_permutex2var_epi32(whole(low), place.raw.raw, whole(high))});
#else
    const auto indices = hn::IndicesFromVec(Tag(), hn::And(place.raw, hn::Set(IntTag(), kLanes - 1)));
    const auto isHigh = hn::RebindMask(Tag(), hn::Gt(place.raw, hn::Set(IntTag(), kLanes - 1)));
    return hn::IfThenElse(isHigh, hn::TableLookupLanes(high, indices), hn::TableLookupLanes(low, indices));
#endif
  }
};

/// For each lane, the pixels at `place` and `place` + 1 of a row.
HWY_INLINE Pair pairAt(const std::uint32_t* from, Ints place) {
  const RowPart<hn::RebindToUnsigned<IntTag>> part(from);
  const auto at = [&](Ints each) { return Ints(hn::BitCast(IntTag(), part.at(each))); };
  return {at(place), at(place + 1)};
}
#endif

/// The four pixels that bilinear interpolation takes.
struct Neighbours {
  Pair above;
  Pair below;
};

/// The neighbours right of and below (column, row), wherever they are: one load for each lane.
HWY_INLINE Neighbours lookUpNeighbours(const std::uint32_t* pixels, int stride, Ints column, Ints row) {
  const Ints at = row * stride + column;
  return {lookUpPair(pixels, at), lookUpPair(pixels + stride, at)};
}

HWY_INLINE Pair select(Mask mask, const Pair& yes, const Pair& no) {
  return {select(mask, yes.first, no.first), select(mask, yes.second, no.second)};
}

}  // namespace grove::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
