#include "stream/encode/h264/prediction/fit_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stream/encode/h264/prediction/fit_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Values = hn::CappedTag<std::int16_t, kMacroblock>;
using Bytes = hn::Rebind<std::uint8_t, Values>;
using Vec = hn::Vec<Values>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Values()));

Offset offsetOf(const MacroblockPixels& source, const MacroblockPixels& prediction) {
  const Values words;
  const Bytes bytes;
  const hn::RepartitionToWide<Values> sums;
  // The rim has no gradients.
  HWY_ALIGN constexpr std::int16_t kInside[kMacroblock] = {0,  -1, -1, -1, -1, -1, -1, -1,
                                                           -1, -1, -1, -1, -1, -1, -1, 0};
  struct Sum {
    hn::Vec<decltype(sums)> even, odd;
    HWY_INLINE void add(Vec a, Vec b) { even = hn::ReorderWidenMulAccumulate(decltype(sums)(), a, b, even, odd); }
    HWY_INLINE float total() const {
      const decltype(sums) tag;
      return static_cast<float>(hn::GetLane(hn::SumOfLanes(tag, hn::Add(even, odd))));
    }
  };
  const auto zero = hn::Zero(sums);
  Sum xx{zero, zero}, xy{zero, zero}, yy{zero, zero}, xe{zero, zero}, ye{zero, zero};
  const auto load = [&](const std::uint8_t* at) { return hn::PromoteTo(words, hn::LoadU(bytes, at)); };
  constexpr std::ptrdiff_t kStride = MacroblockPixels::kStride;
  for (int left = 0; left < kMacroblock; left += kLanes) {
    const auto inside = hn::Load(words, kInside + left);
    const std::uint8_t* p = prediction.luma.data() + left;
    const std::uint8_t* of = source.luma.data() + left;
    Vec above = load(p);
    Vec middle = load(p + kStride);
    for (int top = 1; top < kMacroblock - 1; ++top) {
      p += kStride;
      of += kStride;
      const Vec below = load(p + kStride);
      const Vec x = hn::And(inside, hn::Sub(load(p + 1), load(p - 1)));
      const Vec y = hn::And(inside, hn::Sub(below, above));
      const Vec e = hn::Sub(load(of), middle);
      xx.add(x, x);
      xy.add(x, y);
      yy.add(y, y);
      xe.add(x, e);
      ye.add(y, e);
      above = middle;
      middle = below;
    }
  }
  const float sumXx = xx.total();
  const float sumXy = xy.total();
  const float sumYy = yy.total();
  const float determinant = sumXx * sumYy - sumXy * sumXy;
  if (determinant < 1.0e-2F * sumXx * sumYy + 1.0F) return {0.0F, 0.0F};
  // Differences are of pixels two apart.
  const float scale = 2.0F / determinant;
  const float sumXe = xe.total();
  const float sumYe = ye.total();
  return {scale * (sumYy * sumXe - sumXy * sumYe), scale * (sumXx * sumYe - sumXy * sumXe)};
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::stream::h264 {

HWY_EXPORT(offsetOf);

Offset offsetOf(const MacroblockPixels& source, const MacroblockPixels& prediction) {
  return HWY_DYNAMIC_DISPATCH(offsetOf)(source, prediction);
}

}  // namespace grove::stream::h264

#endif  // HWY_ONCE
