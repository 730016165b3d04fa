#include "objects/ground/frontend/root_kernels.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/ground/frontend/root_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "objects/ground/frontend/halves_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::ground::HWY_NAMESPACE {
namespace {

namespace lanes = grove::simd::HWY_NAMESPACE;
using lanes::Floats;
using lanes::Ints;

/// Visible share of the square root of albedo for blades some rows nearer than the pixel that shows them.
struct Shares {
  float tops;        // where blades are shorter than a pixel, only their tops are visible
  float heightStep;  // stalk heights per row

  explicit Shares(const Row& row)
      : tops(std::clamp(1.5F - 0.5F * row.pixelsPerMetre * (0.35F * kTallest), 0.0F, 1.0F)),
        heightStep(1.0F / (std::max(1e-3F, row.pixelsPerMetre) * (0.62F * kTallest))) {}

  HWY_INLINE Floats reliefAt(Ints above) const {
    // Grass is dark deep inside; the curve approximates the square root of 0.30 + 1.05 * stalk.
    const Floats stalk = lanes::sqrt(lanes::min(1.0F, (lanes::toFloats(above) + 0.5F) * heightStep));
    return stalk * (Floats(0.86F) - stalk * 0.25F) + 0.548F;
  }
};

using Roots = std::array<std::int32_t, kRootRows>;

/// For blades up to `reach` rows nearer.
HWY_INLINE void fillRoots(const Shares& shares, int reach, Roots& roots) {
  for (int first = 0; first <= reach; first += lanes::kLanes) {
    const Ints above = lanes::upwards() + Ints(first);
    const Floats relief = shares.reliefAt(above);
    const Floats shown = relief + (Floats(1.0F) - relief) * shares.tops;
    const Ints share = lanes::truncate(shown * (kShareSteps / kRootRows) + 0.5F);
    static_assert(kRootRows == 1 << 7);
    lanes::store(lanes::shiftLeft<7>(share) + above, roots.data() + first);
  }
}

/// The result for pixels without a blade in front: bare earth is not darkened.
HWY_INLINE void startRoots(const Shares& shares, const SoilBetween& soil, GrassRows& grass) {
  const float relief = hn::GetLane(shares.reliefAt(0).raw);
  const Halves tops = halves(static_cast<int>(shares.tops * 32767.0F));
  const Halves rest = halves(static_cast<int>((1.0F - relief) * kShareSteps));
  const Halves first = halves(static_cast<int>(relief * (0.5F * kShareSteps) + 0.25F * kRootRows));
  const UnsignedHalfTag tag;
  for (std::size_t i = 0; i < kTile; i += kHalves) {
    const Halves cover = hn::ShiftLeft<2>(hn::Min(grassAt(soil, i), halves(8191)));
    const Halves bare = hn::Max(hn::Sub(halves(32767), cover), tops);
    const Halves share = hn::ShiftLeft<1>(hn::Add(first, hn::MulHigh(bare, rest)));
    const UnsignedHalves whole = hn::AndNot(unsignedHalves(kRootMask), hn::BitCast(tag, share));
    hn::Store(whole, tag, grass.roots.data() + i);
  }
}

/// Rows searched per pass; this many keep the roots in registers.
constexpr std::size_t kTogether = 4;
using TopRows = std::array<const std::int16_t*, kTogether>;

HWY_INLINE void search(const TopRows& tops, const std::array<std::int32_t, kTogether>& found, int row,
                       Root* HWY_RESTRICT roots) {
  const HalfTag tag;
  const Halves wanted = halves(row);
  const std::int16_t* HWY_RESTRICT a = tops[0];
  const std::int16_t* HWY_RESTRICT b = tops[1];
  const std::int16_t* HWY_RESTRICT c = tops[2];
  const std::int16_t* HWY_RESTRICT d = tops[3];
  const Halves rootA = halves(found[0]);
  const Halves rootB = halves(found[1]);
  const Halves rootC = halves(found[2]);
  const Halves rootD = halves(found[3]);
  for (std::size_t i = 0; i < kTile; i += kHalves) {
    Halves root = hn::BitCast(tag, hn::Load(UnsignedHalfTag(), roots + i));
    root = hn::IfThenElse(hn::Gt(hn::Load(tag, a + i), wanted), root, rootA);
    root = hn::IfThenElse(hn::Gt(hn::Load(tag, b + i), wanted), root, rootB);
    root = hn::IfThenElse(hn::Gt(hn::Load(tag, c + i), wanted), root, rootC);
    root = hn::IfThenElse(hn::Gt(hn::Load(tag, d + i), wanted), root, rootD);
    hn::Store(hn::BitCast(UnsignedHalfTag(), root), UnsignedHalfTag(), roots + i);
  }
}

void findRoots(const Row& at, int reach, const SoilBetween& soil, GrassRows& grass) {
  const Shares shares(at);
  alignas(64) Roots roots;
  fillRoots(shares, reach, roots);
  startRoots(shares, soil, grass);
  const int row = at.row;
  TopRows tops{};
  std::array<std::int32_t, kTogether> found{};
  std::size_t count = 0;
  for (int above = 1; above <= reach; ++above) {
    const auto slot = static_cast<std::size_t>((row + above) & (kRootRows - 1));
    if (grass.highest[slot] > row) continue;
    tops[count] = grass.tops.data() + slot * kTile;
    found[count] = roots[static_cast<std::size_t>(above)];
    if (++count == kTogether) {
      search(tops, found, row, grass.roots.data());
      count = 0;
    }
  }
  if (count == 0) return;
  // Searching a row twice changes nothing.
  std::fill(tops.begin() + static_cast<std::ptrdiff_t>(count), tops.end(), tops[count - 1]);
  std::fill(found.begin() + static_cast<std::ptrdiff_t>(count), found.end(), found[count - 1]);
  search(tops, found, row, grass.roots.data());
}

}  // namespace
}  // namespace grove::objects::ground::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::ground {

HWY_EXPORT(findRoots);

void findRoots(const Row& row, int reach, const SoilBetween& soil, GrassRows& grass) {
  HWY_DYNAMIC_DISPATCH(findRoots)(row, reach, soil, grass);
}

}  // namespace grove::objects::ground

#endif  // HWY_ONCE
