#include "objects/figure/backend/shadow/shade_kernels.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/figure/backend/shadow/shade_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the line that includes this file once per target.
#include "base/simd/lanes_inl.h"
#include "base/simd/look_up_inl.h"
#include "world/camera.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::figure::HWY_NAMESPACE {
namespace {

namespace lanes = grove::simd::HWY_NAMESPACE;
using lanes::Floats;
using lanes::Ints;
using lanes::kLanes;
using lanes::Mask;

static_assert(kLanes <= static_cast<int>(kShadePadding));

/// Of the sun: where more is missing, there is shade.
constexpr float kShaded = 0.1F;

void addTexels(const TexelLine& line, float weight, int count, float* sums) {
  const Floats lastColumn(static_cast<float>(line.columns) - 1.001F);
  const Floats lastRow(static_cast<float>(line.rows) - 1.001F);
  const Floats scale(weight / 65535.0F);
  for (int i = 0; i < count; i += kLanes) {
    const Ints index = lanes::upwards() + Ints(i);
    const Floats place = lanes::toFloats(index);
    const Floats column = lanes::clamp(lanes::mulAdd(place, line.step.x, line.first.x), 0.0F, lastColumn);
    const Floats row = lanes::clamp(lanes::mulAdd(place, line.step.y, line.first.y), 0.0F, lastRow);
    const Ints left = lanes::truncate(column);
    const Ints lower = lanes::truncate(row);
    const Ints at = lower * Ints(line.columns) + left;
    const lanes::Pair near = lanes::lookUpPair(line.texels, at);
    const lanes::Pair far = lanes::lookUpPair(line.texels + line.columns, at);
    const Floats across = column - lanes::toFloats(left);
    const auto between = [&](const lanes::Pair& pair) {
      const Floats first = lanes::toFloats(pair.first);
      return lanes::mulAdd(lanes::toFloats(pair.second) - first, across, first);
    };
    const Floats first = between(near);
    const Floats texel = lanes::mulAdd(between(far) - first, row - lanes::toFloats(lower), first);
    const Floats added = lanes::onlyWhere(index < Ints(count), texel * scale);
    lanes::store(lanes::load(sums + i) + added, sums + i);
  }
}

/// 0..255 of 0..1.
HWY_INLINE Ints toByte(Floats share) { return lanes::truncate(lanes::mulAdd(share, 255.0F, 0.5F)); }

HWY_INLINE void layVector(const float* sunFrom, const float* skyFrom, const ShadeLook& look, std::uint32_t* colourAt,
                          float* depthAt) {
  const Floats sun = lanes::load(sunFrom);
  const Floats opacity = lanes::max(sun, lanes::load(skyFrom));
  const Floats depth = lanes::load(depthAt);
  const Ints colour = lanes::load(colourAt);
  const Mask shows = opacity >= Floats(0.5F / 255.0F);
  const Mask free = depth >= Floats(world::kInfiniteDepth);
  const Ints before = lanes::select(free, Ints(0), colour);
  const Floats share = Floats(1.0F) - lanes::toFloats(lanes::shiftRight<24>(before)) * Floats(1.0F / 255.0F);
  const auto channel = [&](float level) { return toByte(sun * share * Floats(level)); };
  const Ints behind = channel(look.colour.r) | lanes::shiftLeft<8>(channel(look.colour.g)) |
                      lanes::shiftLeft<16>(channel(look.colour.b)) | lanes::shiftLeft<24>(toByte(opacity * share));
  lanes::store(lanes::select(shows, before + behind, colour), colourAt);
  const Mask comesForward = shows & (free | (sun > Floats(kShaded)));
  lanes::store(lanes::select(comesForward, lanes::min(depth, look.depth), depth), depthAt);
}

void layShades(const float* sun, const float* sky, const ShadeLook& look, int count, std::uint32_t* colour,
               float* depth) {
  int x = 0;
  for (; x + kLanes <= count; x += kLanes) layVector(sun + x, sky + x, look, colour + x, depth + x);
  if (x >= count) return;
  std::array<std::uint32_t, kLanes> lastColours{};
  std::array<float, kLanes> lastDepths{};
  std::copy(colour + x, colour + count, lastColours.begin());
  std::copy(depth + x, depth + count, lastDepths.begin());
  layVector(sun + x, sky + x, look, lastColours.data(), lastDepths.data());
  std::copy_n(lastColours.begin(), count - x, colour + x);
  std::copy_n(lastDepths.begin(), count - x, depth + x);
}

}  // namespace
}  // namespace grove::objects::figure::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::figure {

HWY_EXPORT(addTexels);
HWY_EXPORT(layShades);

void addTexels(const TexelLine& line, float weight, int count, float* sums) {
  HWY_DYNAMIC_DISPATCH(addTexels)(line, weight, count, sums);
}

void layShades(const float* sun, const float* sky, const ShadeLook& look, int count, std::uint32_t* colour,
               float* depth) {
  HWY_DYNAMIC_DISPATCH(layShades)(sun, sky, look, count, colour, depth);
}

}  // namespace grove::objects::figure

#endif  // HWY_ONCE
