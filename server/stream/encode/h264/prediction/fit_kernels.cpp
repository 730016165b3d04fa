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

int differenceOf(const MacroblockPixels& a, const MacroblockPixels& b) {
  const hn::CappedTag<std::uint8_t, 32> bytes;
  const hn::Repartition<std::uint64_t, decltype(bytes)> sums;
  auto sum = hn::Zero(sums);
  for (std::size_t i = 0; i < a.luma.size(); i += hn::Lanes(bytes)) {
    const auto left = hn::Load(bytes, a.luma.data() + i);
    const auto right = hn::Load(bytes, b.luma.data() + i);
    sum = hn::Add(sum, hn::SumsOf8(hn::Or(hn::SaturatedSub(left, right), hn::SaturatedSub(right, left))));
  }
  return static_cast<int>(hn::GetLane(hn::SumOfLanes(sums, sum)));
}

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
    for (int top = 1; top < kMacroblock - 1; ++top) {
      const std::ptrdiff_t at = top * kStride + left;
      const std::uint8_t* const p = prediction.luma.data() + at;
      const Vec x = hn::And(inside, hn::Sub(load(p + 1), load(p - 1)));
      const Vec y = hn::And(inside, hn::Sub(load(p + kStride), load(p - kStride)));
      const Vec e = hn::Sub(load(source.luma.data() + at), load(p));
      xx.add(x, x);
      xy.add(x, y);
      yy.add(y, y);
      xe.add(x, e);
      ye.add(y, e);
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

HWY_EXPORT(differenceOf);
HWY_EXPORT(offsetOf);

int differenceOf(const MacroblockPixels& a, const MacroblockPixels& b) {
  return HWY_DYNAMIC_DISPATCH(differenceOf)(a, b);
}

Offset offsetOf(const MacroblockPixels& source, const MacroblockPixels& prediction) {
  return HWY_DYNAMIC_DISPATCH(offsetOf)(source, prediction);
}

}  // namespace grove::stream::h264

#endif  // HWY_ONCE
