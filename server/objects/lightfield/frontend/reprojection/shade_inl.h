// Colours of a reprojected tile. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_FRONTEND_SHADE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_FRONTEND_SHADE_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_FRONTEND_SHADE_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_FRONTEND_SHADE_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "base/simd/channels_inl.h"
#include "objects/lightfield/common/layered_haze.h"
#include "objects/lightfield/frontend/reprojection/texels_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

/// Steps of a share: 256.
constexpr float kShares = 256.0F;
constexpr float kRounding = 0.5F;

HWY_INLINE Ints share(Floats part) { return truncate(mulAdd(part, kShares, kRounding)); }
HWY_INLINE Channels eachOf(std::uint32_t value) { return channels(static_cast<std::int32_t>(value)); }

/// The haze in the form that shade() needs.
struct Air {
  Channels clear;
  Channels even;
  Channels odd;

  explicit Air(const Haze& haze) {
    const float amount = std::clamp(haze.amount, 0.0F, 1.0F);
    const auto part = [](float value) { return static_cast<std::uint32_t>(value * kShares + kRounding); };
    const auto hazy = [&](std::size_t channel) { return part(amount * std::clamp(haze.colour[channel], 0.0F, 1.0F)); };
    clear = eachOf((256U - part(amount)) * 0x00010001U);
    even = eachOf(hazy(2) << 16U | hazy(0));
    odd = eachOf(part(amount) << 16U | hazy(1));
  }
};

#if GROVE_SIMD_PERMUTES
/// Adjacent pixels mostly use adjacent texels: two registers of each of four rows contain all of them.
HWY_INLINE Neighbours neighbours(const Texels& texels, const std::uint32_t* colour, Ints column, Ints row) {
  constexpr int kMarginAcross = 4;
  constexpr int kRows = 3;  // plus one below
  const auto ends = [](Ints places, int margin, int most) {
    const int first = hn::GetLane(places.raw);
    const int last = hn::ExtractLane(places.raw, kLanes - 1);
    return std::clamp(std::min(first, last) - margin, 0, most);
  };
  const int left = ends(column, kMarginAcross, texels.stride);
  const int top = ends(row, 1, texels.rows - (kRows + 1));
  const Ints right = column - left;
  const Ints down = row - top;
  const Ints outside = hn::Or(hn::ShiftRight<(kLanes == 16 ? 5 : 4)>((right + 1).raw), hn::ShiftRight<2>(down.raw));
  if (HWY_UNLIKELY(any((outside != 0) | (right < 0) | (down > kRows - 1)))) {
    return lookUpNeighbours(colour, texels.stride, column, row);
  }
  const std::uint32_t* const from = colour + std::ptrdiff_t{top} * texels.stride + left;
  const auto line = [&](int each) { return pairAt(from + std::ptrdiff_t{each} * texels.stride, right); };
  if (HWY_LIKELY(all(down == 1))) return {line(1), line(2)};
  const Pair second = line(1);
  Neighbours found{line(0), second};
  const Pair third = line(2);
  const Mask isSecond = down == 1;
  found = {select(isSecond, second, found.above), select(isSecond, third, found.below)};
  const Mask isThird = down == 2;
  return {select(isThird, third, found.above), select(isThird, line(3), found.below)};
}
#else
HWY_INLINE Neighbours neighbours(const Texels& texels, const std::uint32_t* colour, Ints column, Ints row) {
  return lookUpNeighbours(colour, texels.stride, column, row);
}
#endif

/// Shades a vector of adjacent pixels; true where one is covered.
HWY_INLINE Mask shadePixels(const Texels& texels, const std::uint32_t* colour, const Air& air, WarpTile& tile,
                            int first) {
  const Floats w = load(tile.place + first);
  const Floats scale = 1.0F - texels.m.z * w;
  const Floats x = clamp(mulAdd(load(tile.a0 + first), scale, texels.m.x * w - 0.5F), 0.0F, texels.limitX);
  const Floats y = clamp(mulAdd(load(tile.a1 + first), scale, texels.m.y * w - 0.5F), 0.0F, texels.limitY);
  const Ints column = truncate(x);
  const Ints row = truncate(y);
  const Bilinear weights(share(x - toFloats(column)), share(y - toFloats(row)));
  const auto [above, below] = neighbours(texels, colour, column, row);
  const Channels even = whole(weights.sumOf<0>(above, below));
  const Channels odd = whole(weights.sumOf<8>(above, below));
  const Ints cover = shiftRight<16>(Ints(hn::BitCast(IntTag(), odd)));
  const Channels hazed = twice(cover);
  const Channels hazedEven = whole(hn::Add(hn::Mul(even, air.clear), hn::Mul(hazed, air.even)));
  const Channels hazedOdd = whole(hn::Add(hn::Mul(odd, air.clear), hn::Mul(hazed, air.odd)));
  const Floats near = load(tile.near + first);
  const Mask there = (near > 0.0F) & (cover != 0);
  const Floats away = (1.0F / max(near, 1.0e-20F) - texels.m.z) * load(tile.perForward + first);
  const Ints pixel = shiftLeft<8>(Ints(hn::BitCast(IntTag(), hazedOdd))) | Ints(hn::BitCast(IntTag(), hazedEven));
  store(onlyWhere(there, pixel), tile.colour + first);
  store(select(there, away, world::kInfiniteDepth), tile.depth + first);
  return there;
}

/// Bilinear colour through haze, and depth. Returns false if no pixel is covered.
HWY_INLINE bool shade(const Texels& texels, const std::uint32_t* colour, const TileHaze& haze, WarpTile& tile) {
  static_assert(kTileWidth % kLanes == 0);
  Haze ofRow = haze.first;
  Air air(ofRow);
  Mask shows;
  for (int row = 0; row < kTileHeight; ++row) {
    for (int i = 0; i < kTileWidth; i += kLanes) {
      shows |= shadePixels(texels, colour, air, tile, row * kTileWidth + i);
    }
    if (haze.perRow == 0.0F) continue;
    ofRow.amount += haze.perRow;
    air = Air(ofRow);
  }
  return any(shows);
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
