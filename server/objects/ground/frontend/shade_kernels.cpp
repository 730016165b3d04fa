#include "objects/ground/frontend/shade_kernels.h"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/ground/frontend/shade_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "objects/ground/frontend/halves_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::ground::HWY_NAMESPACE {
namespace {

struct Curve {
  const FineSoil::Channels& first;
  const FineSoil::Channels& step;

  /// Displayed values 0..255 of one vector from `i` on, for square roots of albedo `root`.
  HWY_INLINE UnsignedHalves shown(std::size_t i, Halves steps, UnsignedHalves root) const {
    const HalfTag tag;
    const auto at = [&](const FineSoil::Line& from, const FineSoil::Line& by) {
      return hn::Add(hn::Load(tag, from.data() + i), hn::Mul(hn::Load(tag, by.data() + i), steps));
    };
    const Halves q = hn::BitCast(tag, root);
    const Halves slope = hn::Add(at(first.slope, step.slope), hn::MulFixedPoint15(q, at(first.square, step.square)));
    const Halves level = hn::Add(at(first.base, step.base), hn::MulHigh(q, slope));
    static_assert(kSoilSteps == 16.0F);
    const Halves limited = hn::Min(hn::Max(level, halves(0)), halves(256 * 16 - 1));
    return hn::ShiftRight<4>(hn::BitCast(UnsignedHalfTag(), limited));
  }
};

/// Interpolates a row's inverse depths: what to add to that of the sample before each pixel.
HWY_INLINE void spreadSlopes(const float* HWY_RESTRICT samples, float* HWY_RESTRICT out) {
  const hn::CappedTag<float, kCoarse> tag;
  constexpr std::size_t kColumns = hn::MaxLanes(tag);
  for (std::size_t i = 0; i < kTile / kCoarse; ++i) {
    const auto step = hn::Set(tag, (samples[i + 1] - samples[i]) * (1.0F / kCoarse));
    for (std::size_t from = 0; from < kCoarse; from += kColumns) {
      hn::Store(hn::Mul(hn::Iota(tag, static_cast<float>(from)), step), tag, out + i * kCoarse + from);
    }
  }
}

/// Computes each pixel's texel index in the rows of grass, and its depth: that of its blade's row, as slanted as its
/// own.
HWY_INLINE void place(int row, const GrassRows& grass, std::int32_t* HWY_RESTRICT at, float* HWY_RESTRICT depth) {
  const hn::Repartition<std::int32_t, HalfTag> indexTag;
  const hn::Repartition<float, HalfTag> depthTag;
  const hn::Rebind<Root, PixelTag> rootTag;
  alignas(64) std::array<float, kTile> slopes;
  spreadSlopes(grass.inverseDepths.data() + static_cast<std::size_t>(row & (kRootRows - 1)) * kCoarsePadded,
               slopes.data());
  alignas(64) std::array<std::int32_t, kTile> sample;
  const auto thisRow = hn::Set(indexTag, row);
  const auto rowMask = hn::Set(indexTag, kRootRows - 1);
  for (std::size_t i = 0; i < kTile; i += kPixels) {
    const auto root = hn::PromoteTo(indexTag, hn::Load(rootTag, grass.roots.data() + i));
    const auto above = hn::And(root, rowMask);
    const auto slot = hn::And(hn::Add(above, thisRow), rowMask);
    const auto column = hn::Iota(indexTag, static_cast<std::int32_t>(i));
    static_assert(kTile == (1 << 7) + (1 << 5) && kCoarsePadded == 1 << 5 && kCoarse == 1 << 3);
    const auto line = hn::Add(hn::ShiftLeft<7>(slot), hn::ShiftLeft<5>(slot));
    hn::Store(hn::Add(line, column), indexTag, at + i);
    hn::Store(hn::Add(hn::ShiftLeft<5>(slot), hn::ShiftRight<3>(column)), indexTag, sample.data() + i);
  }
  alignas(64) std::array<float, kTile> inverse;
  for (std::size_t i = 0; i < kTile; ++i) inverse[i] = grass.inverseDepths[static_cast<std::size_t>(sample[i])];
  for (std::size_t i = 0; i < kTile; i += kPixels) {
    const auto sum = hn::Add(hn::Load(depthTag, inverse.data() + i), hn::Load(depthTag, slopes.data() + i));
    hn::StoreU(hn::Div(hn::Set(depthTag, 1.0F), sum), depthTag, depth + i);
  }
}

void shadeRow(int row, const SoilBetween& soil, const GrassRows& grass, std::uint32_t* HWY_RESTRICT colour,
              float* HWY_RESTRICT depth) {
  alignas(64) std::array<std::int32_t, kTile> at;
  alignas(64) std::array<std::uint32_t, kTile> grown;
  place(row, grass, at.data(), depth);
  lookUp<kTile>(grass.texels.data(), at.data(), grown.data());

  const Curve low{soil.first.low, soil.step.low};
  const Curve high{soil.first.high, soil.step.high};
  const Halves steps = halves(soil.steps);
  const UnsignedHalfTag tag;
  const PixelTag pixelTag;
  const hn::Rebind<Root, PixelTag> rootTag;
  const UnsignedHalves lowByte = unsignedHalves(0xFF);
  for (std::size_t i = 0; i < kTile; i += kPixels) {
    const UnsignedHalves texel = hn::BitCast(tag, hn::Load(pixelTag, grown.data() + i));
    const Pixels root = hn::PromoteTo(pixelTag, hn::Load(rootTag, grass.roots.data() + i));
    // The visible share in both halves of each pixel.
    const Pixels whole = hn::AndNot(hn::Set(pixelTag, kRootMask), root);
    const UnsignedHalves share = hn::BitCast(tag, hn::Or(whole, hn::ShiftLeft<16>(whole)));
    const UnsignedHalves lowRoot = hn::MulHigh(hn::ShiftLeft<7>(hn::And(texel, lowByte)), share);
    const UnsignedHalves highRoot = hn::MulHigh(hn::ShiftLeft<7>(hn::ShiftRight<8>(texel)), share);
    const UnsignedHalves lower = low.shown(2 * i, steps, lowRoot);
    const UnsignedHalves upper = hn::ShiftLeft<8>(high.shown(2 * i, steps, highRoot));
    hn::StoreU(hn::BitCast(pixelTag, hn::Or(lower, upper)), pixelTag, colour + i);
  }
}

}  // namespace
}  // namespace grove::objects::ground::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::ground {

HWY_EXPORT(shadeRow);

void shadeRow(int row, const SoilBetween& soil, const GrassRows& grass, std::uint32_t* colour, float* depth) {
  HWY_DYNAMIC_DISPATCH(shadeRow)(row, soil, grass, colour, depth);
}

}  // namespace grove::objects::ground

#endif  // HWY_ONCE
