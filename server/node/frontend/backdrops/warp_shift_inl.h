// Cells of a warped backdrop that are shifted as they are. For kernels: included once per target.

#if defined(GROVE_NODE_FRONTEND_BACKDROPS_WARP_SHIFT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_NODE_FRONTEND_BACKDROPS_WARP_SHIFT_INL_H
#undef GROVE_NODE_FRONTEND_BACKDROPS_WARP_SHIFT_INL_H
#else
#define GROVE_NODE_FRONTEND_BACKDROPS_WARP_SHIFT_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "node/frontend/backdrops/warp_pixels_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::node::HWY_NAMESPACE {

/// A cell whose corners lie, to this many pixels, as far apart as in the frame is shifted and not stretched, which is
/// cheaper by far: neighbours are read at once, and all have the same shares.
constexpr float kMaxStretch = 0.25F;

HWY_INLINE std::uint16_t shareOf256(float part) {
  constexpr float kRounding = 0.5F;
  const float share = part * 256.0F + kRounding;
  return static_cast<std::uint16_t>(share);
}

/// Where a shifted cell lies, if it is one.
struct Shift {
  int column = 0;
  int row = 0;
  std::uint16_t right = 0;  ///< shares of 256
  std::uint16_t down = 0;
  bool isOne = false;

  HWY_INLINE Shift(const WarpSource& source, const CornerLine& above, const CornerLine& below, int cell) {
    const auto isAs = [](float difference, float wanted) { return std::abs(difference - wanted) < kMaxStretch; };
    isOne = isAs(above.x[cell + 1] - above.x[cell], 8.0F) && isAs(below.x[cell + 1] - below.x[cell], 8.0F) &&
            isAs(above.y[cell + 1] - above.y[cell], 0.0F) && isAs(below.y[cell + 1] - below.y[cell], 0.0F) &&
            isAs(below.y[cell] - above.y[cell], 8.0F) && isAs(below.x[cell] - above.x[cell], 0.0F);
    if (!isOne) return;
    const auto middle = [&](const float* a, const float* b) {
      return 0.25F * (a[cell] + a[cell + 1] + b[cell] + b[cell + 1]) - 4.0F;
    };
    const float x = middle(above.x, below.x);
    const float y = middle(above.y, below.y);
    const float left = std::floor(x);
    const float top = std::floor(y);
    column = static_cast<int>(left);
    row = static_cast<int>(top);
    right = shareOf256(x - left);
    down = shareOf256(y - top);
    // All that is read is there.
    isOne = column >= 0 && row >= 0 && column + 9 <= source.width && row + 9 <= source.height;
  }
};

/// Pixels of a cell, row by row, as many as there are lanes: one row of eight, two, or half of one.
template <class Tag>
HWY_INLINE hn::Vec<Tag> loadOfCell(Tag tag, const hn::TFromD<Tag>* from, std::ptrdiff_t stride) {
  if constexpr (hn::MaxLanes(Tag()) == 16) {
    const hn::Half<Tag> half;
    return hn::Combine(tag, hn::LoadU(half, from + stride), hn::LoadU(half, from));
  } else {
    return hn::LoadU(tag, from);
  }
}
template <class Tag>
HWY_INLINE void storeOfCell(Tag tag, hn::Vec<Tag> value, hn::TFromD<Tag>* to, std::ptrdiff_t stride) {
  if constexpr (hn::MaxLanes(Tag()) == 16) {
    const hn::Half<Tag> half;
    hn::StoreU(hn::LowerHalf(half, value), half, to);
    hn::StoreU(hn::UpperHalf(half, value), half, to + stride);
  } else {
    hn::StoreU(value, tag, to);
  }
}

/// One cell.
class ShiftedCell {
 public:
  HWY_INLINE ShiftedCell(const WarpSource& source, const Shift& shift)
      : source_(source),
        shift_(shift),
        right_(hn::Set(ChannelTag(), shift.right)),
        left_(hn::Set(ChannelTag(), static_cast<std::uint16_t>(256 - shift.right))),
        lower_(hn::Set(ChannelTag(), shift.down)),
        upper_(hn::Set(ChannelTag(), static_cast<std::uint16_t>(256 - shift.down))) {}

  HWY_INLINE void warp(const WarpedPixels& out) const {
    for (int i = 0; i < 64; i += lanes::kLanes) {
      const int row = i / 8;
      const int column = i % 8;
      const std::ptrdiff_t to = row * out.stride + column;
      storeOfCell(ColourTag(), hn::BitCast(ColourTag(), colourAt(row, column).raw), out.colour + to, out.stride);
    }
  }

 private:
  using ColourTag = hn::RebindToUnsigned<lanes::IntTag>;
  struct Halves {
    Channels even;
    Channels odd;
  };

  HWY_INLINE Halves acrossOf(const std::uint32_t* from) const {
    const auto at = [&](const std::uint32_t* pixels) {
      return Ints(hn::BitCast(lanes::IntTag(), loadOfCell(ColourTag(), pixels, source_.width)));
    };
    const Ints a = at(from);
    const Ints b = at(from + 1);
    const auto mix = [&](Ints first, Ints second) {
      const Channels sum = hn::Add(hn::Mul(lanes::channels(first), left_), hn::Mul(lanes::channels(second), right_));
      return lanes::whole(sum);
    };
    const Ints mask(0x00FF00FF);
    return {mix(a & mask, b & mask), mix(lanes::shiftRight<8>(a) & mask, lanes::shiftRight<8>(b) & mask)};
  }

  HWY_INLINE Ints colourAt(int row, int column) const {
    const std::uint32_t* const from =
        source_.colour + std::ptrdiff_t{shift_.row + row} * source_.width + shift_.column + column;
    const Halves above = acrossOf(from);
    const Halves below = acrossOf(from + source_.width);
    const auto mix = [&](Channels first, Channels second) {
      return lanes::rounded(hn::Add(hn::Mul(first, upper_), hn::Mul(second, lower_)));
    };
    const Channels even = hn::ShiftRight<8>(mix(above.even, below.even));
    const Channels odd = highBytes(mix(above.odd, below.odd));
    return Ints(hn::BitCast(lanes::IntTag(), hn::Or(even, odd)));
  }

  const WarpSource& source_;
  const Shift& shift_;
  const Channels right_, left_, lower_, upper_;
};

}  // namespace grove::node::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
