#include "objects/herd/frontend/shadow/deer_shadow_kernels.h"

#include <algorithm>
#include <array>

#include "objects/herd/common/deer_skeleton.h"
#include "objects/herd/frontend/shadow/shadow_mask.h"
#include "world/camera.h"
#include "world/ground/ground_shadow.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/herd/frontend/shadow/deer_shadow_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the line that includes this file once per target.
#include "base/simd/lanes_inl.h"
#include "base/simd/look_up_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::herd::HWY_NAMESPACE {
namespace {

namespace lanes = grove::simd::HWY_NAMESPACE;
using lanes::Floats;
using lanes::Ints;
using lanes::kLanes;
using lanes::Mask;

HWY_INLINE Floats valueAt(const AffineRow& value, Floats column, Floats depth) {
  return lanes::mulAdd(depth, lanes::mulAdd(column, value.perColumn, value.perDepth), value.start);
}

/// From 0 to 1 between two edges, of which the second is `1 / perEdge` later.
HWY_INLINE Floats smoothStep(Floats from, float perEdge, Floats value) {
  const Floats share = lanes::clamp((value - from) * Floats(perEdge), 0.0F, 1.0F);
  return share * share * lanes::mulAdd(share, -2.0F, 3.0F);
}

/// The hidden share of the sun, 0..1.
HWY_INLINE Floats hiddenSun(const std::uint32_t* texels, Floats column, Floats line, Mask where) {
  constexpr auto kLast = static_cast<float>(SunMask::kSide - 1);
  const Floats zero(0.0F);
  const Mask within = where & (column >= zero) & (line >= zero) & (column < Floats(kLast)) & (line < Floats(kLast));
  if (!lanes::any(within)) return zero;
  const Ints left = lanes::truncate(column);
  const Ints top = lanes::truncate(line);
  const Ints four = lanes::lookUp(texels, lanes::onlyWhere(within, top * Ints(SunMask::kSide) + left));
  const Ints byte(0xFF);
  const Floats first = lanes::toFloats(four & byte);
  const Floats second = lanes::toFloats(lanes::shiftRight<8>(four) & byte);
  const Floats third = lanes::toFloats(lanes::shiftRight<16>(four) & byte);
  const Floats fourth = lanes::toFloats(lanes::shiftRight<24>(four));
  const Floats right = column - lanes::toFloats(left);
  const Floats above = lanes::mulAdd(second - first, right, first);
  const Floats below = lanes::mulAdd(fourth - third, right, third);
  const Floats cover = lanes::mulAdd(below - above, line - lanes::toFloats(top), above);
  return lanes::onlyWhere(within, cover * Floats(1.0F / 255.0F));
}

/// The hidden share of the sky, 0..1.
HWY_INLINE Floats hiddenSky(const Contact& contact, Floats x, Floats z, Mask where) {
  const Floats square = lanes::mulAdd(x, x, z * z);
  const Mask within = where & (square <= Floats(contact.radius * contact.radius));
  if (!lanes::any(within)) return 0.0F;
  const Floats one(1.0F);
  const Floats along = lanes::mulAdd(x, contact.ahead.x, z * Floats(contact.ahead.y)) * Floats(contact.perLength);
  const Floats aside = lanes::mulAdd(x, contact.ahead.y, z * Floats(-contact.ahead.x)) * Floats(contact.perWidth);
  const Floats trunk = lanes::max(0.0F, one - along * along - aside * aside);
  Floats light = one - Floats(contact.trunkStrength) * trunk * lanes::sqrt(trunk);
  const Floats perReach(1.0F / (contact.footReach * contact.footReach));
  for (const Contact::Foot& foot : contact.feet) {
    const Floats offX = x - Floats(foot.at.x);
    const Floats offZ = z - Floats(foot.at.y);
    const Floats near = lanes::max(0.0F, one - lanes::mulAdd(offX, offX, offZ * offZ) * perReach);
    light *= one - Floats(foot.strength) * near * near;
  }
  return lanes::onlyWhere(within, one - light);
}

/// 1 at the ground, 0 beyond what shadows fall on; `bend`: metres by which the ground may be off the plane.
HWY_INLINE Floats fadeAt(Floats height, Floats bend) {
  const Floats above = smoothStep(bend + kShadeFadesFrom, 1.0F / (kShadeFadesTo - kShadeFadesFrom), height);
  const Floats below = smoothStep(Floats(kLowestShade) - bend, -2.0F / kLowestShade, height);
  return (Floats(1.0F) - above) * below;
}

/// Depths of the animal's own picture from a column on; -1 where it has none.
HWY_INLINE Floats bodyDepths(const ShadeRow& row, int column) {
  const int begin = std::max(column, row.bodyBegin);
  const int end = std::min(column + kLanes, row.bodyEnd);
  if (begin >= end) return -1.0F;
  const float* const from = row.bodyDepths + (begin - row.bodyBegin);
  if (end - begin == kLanes) return lanes::load(from);
  std::array<float, kLanes> some;
  some.fill(-1.0F);
  std::copy_n(from, end - begin, some.begin() + (begin - column));
  return lanes::load(some.data());
}

HWY_INLINE void shadeVector(const GroundShade& shade, const ShadeRow& row, int first, const float* depths,
                            std::uint32_t* colours) {
  constexpr float kMostBend = kGroundBend * (world::kLongestShadow + kReach);
  const Floats depth = lanes::load(depths);
  const Floats column = lanes::toFloats(lanes::upwards() + Ints(first));
  const Floats height = valueAt(row.height, column, depth);
  // Most pixels are no ground.
  const Mask near = (height > Floats(kLowestShade - kMostBend)) & (height < Floats(kShadeFadesTo + kMostBend));
  if (!lanes::any(near)) return;
  Floats sun = hiddenSun(shade.texels, valueAt(row.column, column, depth), valueAt(row.line, column, depth), near);
  const Floats x = valueAt(row.x, column, depth);
  const Floats z = valueAt(row.z, column, depth);
  const Floats sky = hiddenSky(shade.contact, x, z, near);
  Mask shows = (sun + sky) > Floats(0.0F);
  if (!lanes::any(shows)) return;
  const Mask mayBeOwn = shows & (height > Floats(kOwnHeight));
  if (lanes::any(mayBeOwn)) {
    const Mask isOwn = lanes::abs(bodyDepths(row, first) - depth) <= depth * Floats(kSameDepth);
    shows = lanes::without(shows, mayBeOwn & isOwn);
  }
  const Floats along = lanes::max(0.0F, lanes::mulAdd(x, shade.away.x, z * Floats(shade.away.y)));
  const Floats fade = fadeAt(height, along * Floats(kGroundBend));
  constexpr float kFadeLength = (1.0F - kSunFadesAfter) * world::kLongestShadow;
  const Floats one(1.0F);
  const Floats reach = one - smoothStep(kSunFadesAfter * world::kLongestShadow, 1.0F / kFadeLength, along);
  sun *= Floats(shade.sunStrength) * reach * fade;
  const Floats light = Floats(256.0F) * (one - sky * fade);
  const Ints colour = lanes::load(colours);
  const auto channel = [&](Ints value, float strength) {
    const Ints share = lanes::truncate(light * (one - sun * Floats(strength)));
    return lanes::shiftRight<8>((value & Ints(0xFF)) * share);
  };
  const Ints dark = (colour & Ints(static_cast<std::int32_t>(0xFF000000U))) | channel(colour, kSunStrength.r) |
                    lanes::shiftLeft<8>(channel(lanes::shiftRight<8>(colour), kSunStrength.g)) |
                    lanes::shiftLeft<16>(channel(lanes::shiftRight<16>(colour), kSunStrength.b));
  lanes::store(lanes::select(shows, dark, colour), colours);
}

void shadeGround(const GroundShade& shade, const ShadeRow& row) {
  int column = 0;
  for (; column + kLanes <= row.count; column += kLanes) {
    shadeVector(shade, row, column, row.depths + column, row.colours + column);
  }
  if (column >= row.count) return;
  // What follows the row is neither read nor changed.
  std::array<float, kLanes> depths;
  std::array<std::uint32_t, kLanes> colours{};
  depths.fill(world::kInfiniteDepth);
  std::copy(row.depths + column, row.depths + row.count, depths.begin());
  std::copy(row.colours + column, row.colours + row.count, colours.begin());
  shadeVector(shade, row, column, depths.data(), colours.data());
  std::copy_n(colours.begin(), row.count - column, row.colours + column);
}

}  // namespace
}  // namespace grove::objects::herd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::herd {

HWY_EXPORT(shadeGround);

void shadeGround(const GroundShade& shade, const ShadeRow& row) { HWY_DYNAMIC_DISPATCH(shadeGround)(shade, row); }

}  // namespace grove::objects::herd

#endif  // HWY_ONCE
