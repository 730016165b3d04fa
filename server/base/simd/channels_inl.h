// Arithmetic with the channels of pixels. For kernels: included once per target.

#if defined(GROVE_BASE_SIMD_CHANNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BASE_SIMD_CHANNELS_INL_H
#undef GROVE_BASE_SIMD_CHANNELS_INL_H
#else
#define GROVE_BASE_SIMD_CHANNELS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "base/simd/look_up_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::simd::HWY_NAMESPACE {

/// Two channels of 8 bits, each in 16.
using ChannelTag = hn::Repartition<std::uint16_t, IntTag>;
using Channels = hn::Vec<ChannelTag>;

HWY_INLINE Channels channels(Ints value) { return hn::BitCast(ChannelTag(), value.raw); }
HWY_INLINE Channels twice(Ints value) { return channels(value | shiftLeft<16>(value)); }

/// 256ths, so that their high bytes are rounded wholes.
HWY_INLINE Channels rounded(Channels sum) { return hn::Add(sum, hn::Set(ChannelTag(), std::uint16_t{128})); }
/// From 256ths, rounded.
HWY_INLINE Channels whole(Channels sum) { return hn::ShiftRight<8>(rounded(sum)); }

/// Weights of four neighbouring pixels in bilinear interpolation; they add up to 256.
struct Bilinear {
  Channels w00, w10, w01, w11;

  /// `right` and `down`: shares of 256 of the pixels to the right and below.
  HWY_INLINE Bilinear(Ints right, Ints down) {
    const Ints both = shiftRight<8>(right * down + 128);
    w11 = twice(both);
    w10 = twice(right - both);
    w01 = twice(down - both);
    w00 = twice(256 - right - down + both);
  }

  /// The first and third channels (kShift 0), or the second and fourth (8), in 256ths.
  template <int kShift>
  HWY_INLINE Channels sumOf(const Pair& above, const Pair& below) const {
    const auto part = [](Ints pixel) { return channels(shiftRight<kShift>(pixel) & 0x00FF00FF); };
    return hn::Add(hn::Add(hn::Mul(part(above.first), w00), hn::Mul(part(above.second), w10)),
                   hn::Add(hn::Mul(part(below.first), w01), hn::Mul(part(below.second), w11)));
  }
};

}  // namespace grove::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
