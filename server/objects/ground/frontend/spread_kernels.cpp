#include "objects/ground/frontend/spread_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/ground/frontend/spread_kernels.cpp"
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

struct Scale {
  float factor;
  float min, max;  // limits, so that no sum of products exceeds 16 bits
};
constexpr Scale kBase{kSoilSteps, -12000.0F, 12000.0F};
constexpr Scale kSlope{1.0F / kSlopeStep, -8000.0F, 24000.0F};
constexpr Scale kSquare{1.0F / kSquareStep, -16000.0F, 8000.0F};
constexpr Scale kGrass{kMaxGrass, 0.0F, kMaxGrass};

HWY_INLINE Ints scaled(Floats value, Scale scale) {
  const Floats limited = lanes::clamp(value * scale.factor, scale.min, scale.max);
  return lanes::truncate(limited + 32768.5F) - Ints(32768);
}

/// Samples as pairs of 16-bit numbers.
using Pairs = std::array<std::uint32_t, kCoarsePadded>;

/// Interpolates the columns of two channels linearly between the tile's samples.
HWY_INLINE void spreadPairs(const Pairs& pairs, FineSoil::Line& out) {
  // The columns between two samples, or a vector's worth if that is fewer.
  const hn::CappedTag<std::uint32_t, kCoarse> pairTag;
  const hn::Repartition<std::int16_t, decltype(pairTag)> halfTag;
  constexpr std::size_t kColumns = hn::MaxLanes(pairTag);
  for (std::size_t from = 0; from < kCoarse; from += kColumns) {
    const auto eighths = hn::Mul(hn::Iota(pairTag, static_cast<std::uint32_t>(from)), hn::Set(pairTag, 0x10001000U));
    for (std::size_t i = 0; i < kTile / kCoarse; ++i) {
      const auto left = hn::BitCast(halfTag, hn::Set(pairTag, pairs[i]));
      const auto right = hn::BitCast(halfTag, hn::Set(pairTag, pairs[i + 1]));
      const auto way = hn::MulFixedPoint15(hn::Sub(right, left), hn::BitCast(halfTag, eighths));
      hn::StoreU(hn::Add(left, way), halfTag, out.data() + 2 * (i * kCoarse + from));
    }
  }
}

void spread(const float* HWY_RESTRICT low, const float* HWY_RESTRICT high, Scale scale, FineSoil::Line& out) {
  alignas(64) Pairs pairs;
  for (std::size_t i = 0; i < pairs.size(); i += lanes::kLanes) {
    const Ints lower = scaled(lanes::load(low + i), scale) & Ints(0xFFFF);
    const Ints upper = lanes::shiftLeft<16>(scaled(lanes::load(high + i), scale));
    lanes::store(lower | upper, pairs.data() + i);
  }
  spreadPairs(pairs, out);
}

/// The other channel is constant.
void spread(const float* HWY_RESTRICT low, float high, Scale scale, FineSoil::Line& out) {
  alignas(64) Pairs pairs;
  const Ints upper = lanes::shiftLeft<16>(scaled(high, scale));
  for (std::size_t i = 0; i < pairs.size(); i += lanes::kLanes) {
    lanes::store((scaled(lanes::load(low + i), scale) & Ints(0xFFFF)) | upper, pairs.data() + i);
  }
  spreadPairs(pairs, out);
}

void spreadSoil(const SampledSoil& samples, FineSoil& out) {
  constexpr float kOpaque = 255.9F;
  const auto& [red, green, blue] = samples.channels;
  spread(red.base.data(), blue.base.data(), kBase, out.low.base);
  spread(red.slope.data(), blue.slope.data(), kSlope, out.low.slope);
  spread(red.square.data(), blue.square.data(), kSquare, out.low.square);
  spread(green.base.data(), kOpaque, kBase, out.high.base);
  spread(green.slope.data(), 0.0F, kSlope, out.high.slope);
  spread(green.square.data(), 0.0F, kSquare, out.high.square);
  alignas(64) FineSoil::Line grass;
  spread(samples.grass.data(), 0.0F, kGrass, grass);
  const HalfTag tag;
  for (std::size_t i = 0; i < kTile; i += kHalves) {
    const Halves lower = hn::Load(tag, grass.data() + 2 * i);
    const Halves upper = hn::Load(tag, grass.data() + 2 * i + kHalves);
    hn::Store(hn::ConcatEven(tag, upper, lower), tag, out.grass.data() + i);
  }
}

template <std::size_t kCount>
HWY_INLINE void stepBetween(const std::array<std::int16_t, kCount>& first, const std::array<std::int16_t, kCount>& last,
                            int rows, std::array<std::int16_t, kCount>& out) {
  static_assert(kCount % kHalves == 0);
  const HalfTag tag;
  const int shift = rows / 2;
  const Halves half = hn::Set(tag, static_cast<std::int16_t>(shift));
  for (std::size_t i = 0; i < kCount; i += kHalves) {
    const Halves way = hn::Sub(hn::Load(tag, last.data() + i), hn::Load(tag, first.data() + i));
    hn::Store(hn::ShiftRightSame(hn::Add(way, half), shift), tag, out.data() + i);
  }
}

HWY_INLINE void stepChannels(const FineSoil::Channels& first, const FineSoil::Channels& last, int rows,
                             FineSoil::Channels& out) {
  stepBetween(first.base, last.base, rows, out.base);
  stepBetween(first.slope, last.slope, rows, out.slope);
  stepBetween(first.square, last.square, rows, out.square);
}

void stepSoil(const FineSoil& first, const FineSoil& last, int rows, FineSoil& out) {
  stepChannels(first.low, last.low, rows, out.low);
  stepChannels(first.high, last.high, rows, out.high);
  stepBetween(first.grass, last.grass, rows, out.grass);
}

}  // namespace
}  // namespace grove::objects::ground::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::ground {

HWY_EXPORT(spreadSoil);
HWY_EXPORT(stepSoil);

void spreadSoil(const SampledSoil& samples, FineSoil& out) { HWY_DYNAMIC_DISPATCH(spreadSoil)(samples, out); }

void stepSoil(const FineSoil& first, const FineSoil& last, int rows, FineSoil& out) {
  HWY_DYNAMIC_DISPATCH(stepSoil)(first, last, rows, out);
}

}  // namespace grove::objects::ground

#endif  // HWY_ONCE
