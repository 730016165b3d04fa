// Describes quantised coefficients for those who write them. For kernels: included once per target, after
// <hwy/highway.h>.

#if defined(GROVE_STREAM_ENCODE_H264_RESIDUAL_LEVEL_BITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_STREAM_ENCODE_H264_RESIDUAL_LEVEL_BITS_INL_H
#undef GROVE_STREAM_ENCODE_H264_RESIDUAL_LEVEL_BITS_INL_H
#else
#define GROVE_STREAM_ENCODE_H264_RESIDUAL_LEVEL_BITS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "stream/encode/h264/residual/residual.h"

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Bit i: byte i is set in the mask.
template <class Bytes16, class Mask>
HWY_INLINE std::uint16_t bitsOf(Bytes16 tag, Mask mask) {
  std::uint8_t stored[8];
  hn::StoreMaskBits(tag, mask, stored);
  std::uint16_t bits = 0;
  std::memcpy(&bits, stored, sizeof bits);
  return bits;
}

HWY_INLINE LevelBits levelBitsOf(const Block& block) {
  const hn::FixedTag<std::int16_t, 8> words;
  const hn::FixedTag<std::int8_t, 16> levels;
  const hn::Half<decltype(levels)> half;
  // Saturated, a level keeps what is asked for.
  const auto byFrequency = hn::Combine(levels, hn::DemoteTo(half, hn::Load(words, block.data() + 8)),
                                       hn::DemoteTo(half, hn::Load(words, block.data())));
  const hn::Repartition<std::uint8_t, decltype(levels)> places;
  const auto scan = hn::BitCast(levels, hn::LoadU(places, kScan.data()));
  const auto level = hn::TableLookupBytes(byFrequency, scan);
  const auto zero = hn::Eq(level, hn::Zero(levels));
  const auto one = hn::Eq(hn::Abs(level), hn::Set(levels, 1));
  return {bitsOf(levels, hn::Not(zero)), bitsOf(levels, hn::Not(hn::Or(zero, one))),
          bitsOf(levels, hn::Lt(level, hn::Zero(levels)))};
}

/// Of the blocks whose bits are set.
HWY_INLINE void findLevelBits(std::uint32_t blocks, const Block* of, LevelBits* to) {
  for (std::uint32_t left = blocks; left != 0; left &= left - 1) {
    const int block = std::countr_zero(left);
    to[block] = levelBitsOf(of[block]);
  }
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
