#include "stream/encode/h264/variance_kernels.h"

#include <tuple>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stream/encode/h264/variance_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

float varianceOf(const MacroblockPixels& pixels) {
  const hn::CappedTag<std::int16_t, 32> words;
  const hn::Rebind<std::uint8_t, decltype(words)> bytes;
  const hn::RepartitionToWide<decltype(words)> sums;
  const auto one = hn::Set(words, 1);
  auto sum = hn::Zero(sums);
  auto odd = hn::Zero(sums);
  auto squares = hn::Zero(sums);
  auto oddSquares = hn::Zero(sums);
  for (std::size_t i = 0; i < pixels.luma.size(); i += hn::Lanes(words)) {
    const auto values = hn::PromoteTo(words, hn::Load(bytes, pixels.luma.data() + i));
    sum = hn::ReorderWidenMulAccumulate(sums, values, one, sum, odd);
    squares = hn::ReorderWidenMulAccumulate(sums, values, values, squares, oddSquares);
  }
  const auto total = [&](auto even, auto other) { return hn::GetLane(hn::SumOfLanes(sums, hn::Add(even, other))); };
  constexpr auto kCount = static_cast<float>(std::tuple_size_v<decltype(pixels.luma)>);
  const float mean = static_cast<float>(total(sum, odd)) / kCount;
  return static_cast<float>(total(squares, oddSquares)) / kCount - mean * mean;
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::stream::h264 {

HWY_EXPORT(varianceOf);

float varianceOf(const MacroblockPixels& pixels) { return HWY_DYNAMIC_DISPATCH(varianceOf)(pixels); }

}  // namespace grove::stream::h264

#endif  // HWY_ONCE
