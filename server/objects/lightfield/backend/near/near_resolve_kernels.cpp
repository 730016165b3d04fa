#include "objects/lightfield/backend/near/near_resolve_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "world/camera.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/backend/near/near_resolve_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::FixedTag<std::uint16_t, NearPixels::kColumns>;
using Bytes = hn::FixedTag<std::uint8_t, NearPixels::kColumns>;
using Depths = hn::CappedTag<float, NearPixels::kColumns>;
using WordVec = hn::Vec<Words>;
constexpr std::size_t kDepthLanes = hn::MaxLanes(Depths());

/// Mixes haze into colours, in steps of 1 / 256.
class HazeMix {
 public:
  HWY_INLINE explicit HazeMix(const Haze& haze) {
    const auto of = [](float share) { return static_cast<std::uint16_t>(std::lround(256.0F * share)); };
    kept_ = of(1.0F - haze.amount);
    for (std::size_t c = 0; c < 3; ++c) {
      // Rounded sums must not exceed 256, since a product has 16 bits.
      added_[c] = std::min(of(haze.colour[c] * haze.amount), static_cast<std::uint16_t>(256 - kept_));
    }
  }

  HWY_INLINE WordVec mixed(WordVec value, WordVec alpha, std::size_t channel) const {
    const Words words;
    const auto sum = hn::Add(hn::Mul(value, hn::Set(words, kept_)), hn::Mul(alpha, hn::Set(words, added_[channel])));
    return hn::ShiftRight<8>(hn::Add(sum, hn::Set(words, 128)));
  }

 private:
  std::uint16_t kept_;
  std::uint16_t added_[3];
};

/// The mean of sums over a pixel's samples.
HWY_INLINE WordVec mean(WordVec sum) {
  static_assert(kPixelSamples == 16);
  return hn::ShiftRight<4>(hn::Add(sum, hn::Set(Words(), 8)));
}

HWY_INLINE void resolveColours(const NearPixels& pixels, std::size_t first, const HazeMix& haze, std::uint32_t* to) {
  const Words words;
  const Bytes bytes;
  const auto count = hn::PopulationCount(hn::Load(words, pixels.covered + first));
  const auto alpha = mean(hn::Mul(count, hn::Set(words, 255)));
  const auto channel = [&](std::size_t c) {
    return hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<Words>(),
                                           haze.mixed(mean(hn::Load(words, pixels.colour[c] + first)), alpha, c)));
  };
  hn::StoreInterleaved4(channel(0), channel(1), channel(2),
                        hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<Words>(), alpha)), bytes,
                        reinterpret_cast<std::uint8_t*>(to));
}

HWY_INLINE void resolveDepths(const NearPixels& pixels, std::size_t first, float* to) {
  const Depths tag;
  const hn::Rebind<std::int16_t, Depths> words;
  const hn::RebindToSigned<Depths> ints;
  for (std::size_t i = 0; i < NearPixels::kColumns; i += kDepthLanes) {
    const auto nearness = hn::ConvertTo(tag, hn::PromoteTo(ints, hn::Load(words, pixels.nearness + first + i)));
    const auto depth = hn::Div(hn::Set(tag, kNearnessUnit), hn::Max(nearness, hn::Set(tag, 1.0F)));
    hn::StoreU(hn::IfThenElse(hn::Gt(nearness, hn::Zero(tag)), depth, hn::Set(tag, world::kInfiniteDepth)), tag,
               to + i);
  }
}

void resolveTile(int left, int top, const Haze& haze, NearCanvas& canvas, raster::Image& image) {
  const HazeMix hazeMix(haze);
  const int width = std::min(kNearTile, image.width() - left);
  const int height = std::min(kNearTile, image.height() - top);
  HWY_ALIGN std::uint32_t colours[kNearTile];
  HWY_ALIGN float depths[kNearTile];
  for (int y = 0; y < height; ++y) {
    const auto first = static_cast<std::size_t>(y % NearPixels::kRows) * NearPixels::kColumns;
    for (int column = 0; column < NearCanvas::kAcross; ++column) {
      const NearPixels& pixels = canvas.row(y / NearPixels::kRows)[column];
      resolveColours(pixels, first, hazeMix, colours + std::ptrdiff_t{column} * NearPixels::kColumns);
      resolveDepths(pixels, first, depths + std::ptrdiff_t{column} * NearPixels::kColumns);
    }
    std::copy_n(colours, width, image.colourRow(top + y) + left);
    std::copy_n(depths, width, image.depthRow(top + y) + left);
  }
  canvas.clear();
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(resolveTile);

void resolveTile(int left, int top, const Haze& haze, NearCanvas& canvas, raster::Image& image) {
  HWY_DYNAMIC_DISPATCH(resolveTile)(left, top, haze, canvas, image);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
