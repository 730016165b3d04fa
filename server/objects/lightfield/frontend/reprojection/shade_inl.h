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
#include "objects/lightfield/common/haze.h"
#include "objects/lightfield/frontend/reprojection/texels_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

/// Steps to a share of 256.
constexpr float kShares = 256.0F;
constexpr float kRounding = 0.5F;

HWY_INLINE Ints share(Floats part) { return truncate(mulAdd(part, kShares, kRounding)); }
HWY_INLINE Channels eachOf(std::uint32_t value) { return channels(static_cast<std::int32_t>(value)); }

/// The air as shade() mixes it in.
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

/// As many neighbouring pixels as there are lanes; true where one shows anything.
HWY_INLINE Mask shadePixels(const Texels& texels, const std::uint32_t* colour, const Air& air, WarpTile& tile,
                            int first) {
  const Floats w = load(tile.place + first);
  const Floats scale = 1.0F - texels.m.z * w;
  const Floats x = clamp(mulAdd(load(tile.a0 + first), scale, texels.m.x * w - 0.5F), 0.0F, texels.limitX);
  const Floats y = clamp(mulAdd(load(tile.a1 + first), scale, texels.m.y * w - 0.5F), 0.0F, texels.limitY);
  const Ints column = truncate(x);
  const Ints row = truncate(y);
  const Bilinear weights(share(x - toFloats(column)), share(y - toFloats(row)));
  const Ints at = row * texels.stride + column;
  const Pair above = lookUpPair(colour, at);
  const Pair below = lookUpPair(colour + texels.stride, at);
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

/// Bilinear colour through the haze, and depth. False if nothing shows.
HWY_INLINE bool shade(const Texels& texels, const std::uint32_t* colour, const Haze& haze, WarpTile& tile) {
  const Air air(haze);
  Mask shows;
  for (int i = 0; i < kTilePixels; i += kLanes) shows |= shadePixels(texels, colour, air, tile, i);
  return any(shows);
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
