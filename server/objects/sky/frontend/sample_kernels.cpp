#include "objects/sky/frontend/sample_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/floor_to.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/sky/frontend/sample_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::sky::HWY_NAMESPACE {
namespace {

namespace lanes = grove::simd::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;
using lanes::Floats;
using lanes::Ints;
using lanes::kLanes;

/// Returns the angle from `ahead` to `side` in turns (1 = full circle); error below 2e-6. Odd minimax polynomial on
/// 0..1, then octants.
HWY_INLINE Floats turnsOf(Floats side, Floats ahead) {
  const Floats a = lanes::abs(side);
  const Floats b = lanes::abs(ahead);
  const Floats x = lanes::min(a, b) / (lanes::max(a, b) + 1e-20F);
  const Floats x2 = x * x;
  Floats angle = lanes::mulAdd(x2, -0.01172120F, 0.05265332F);
  angle = lanes::mulAdd(x2, angle, -0.11643287F);
  angle = lanes::mulAdd(x2, angle, 0.19354346F);
  angle = lanes::mulAdd(x2, angle, -0.33262347F);
  angle = lanes::mulAdd(x2, angle, 0.99997726F) * x * (0.5F * std::numbers::inv_pi_v<float>);
  angle = lanes::select(a > b, Floats(0.25F) - angle, angle);
  angle = lanes::select(ahead < Floats(0.0F), Floats(0.5F) - angle, angle);
  return lanes::select(side < Floats(0.0F), -angle, angle);
}

constexpr int kKnot = 16;      // samples between exactly computed ones
constexpr int kChunk = 256;    // samples per batch
constexpr float kBend = 0.6F;  // texels that a row's path through the panorama may bend between knots
static_assert(kKnot % kLanes == 0);

/// Positions in the panorama, in texels. Columns may exceed the width by up to a turn.
struct Places {
  alignas(64) std::array<float, kChunk + kKnot> x;
  alignas(64) std::array<float, kChunk + kKnot> y;
};

/// Computes the positions of `count` samples from `first` on, `apart` from each other. Rounds up to whole vectors.
HWY_INLINE void aim(const Panorama& panorama, const RowOfRays& row, int first, int apart, int count, Places& out) {
  const auto width = static_cast<float>(panorama.width());
  const auto height = static_cast<float>(panorama.height() - 1);
  const float sideStep = row.sideStep * static_cast<float>(apart);
  const float firstSide = row.firstSide + row.sideStep * static_cast<float>(first);
  // A row's left end is up to half a turn away.
  const float left = -row.yaw * 0.5F * std::numbers::inv_pi_v<float> - 0.5F;
  const float turned = left - std::floor(left) + 0.5F;
  for (int i = 0; i < count; i += kLanes) {
    const Floats side = lanes::mulAdd(lanes::toFloats(lanes::upwards() + Ints(i)), sideStep, firstSide);
    const Floats across = lanes::sqrt(side * side + row.ahead * row.ahead);
    const Floats above = lanes::max(0.0F, across * Panorama::kBelow + row.up);
    lanes::store((turnsOf(side, row.ahead) + turned) * width, out.x.data() + i);
    lanes::store(above / (above + across * Panorama::kSpread) * height, out.y.data() + i);
  }
}

/// Interpolates linearly from each knot to the next.
HWY_INLINE void joinKnots(const Places& knots, Places& out) {
  for (int knot = 0; knot < kChunk / kKnot; ++knot) {
    const auto at = static_cast<std::size_t>(knot);
    const Floats x = knots.x[at];
    const Floats y = knots.y[at];
    const Floats xStep = (knots.x[at + 1] - knots.x[at]) * (1.0F / kKnot);
    const Floats yStep = (knots.y[at + 1] - knots.y[at]) * (1.0F / kKnot);
    for (int i = 0; i < kKnot; i += kLanes) {
      const Floats steps = lanes::toFloats(lanes::upwards() + Ints(i));
      lanes::store(lanes::mulAdd(steps, xStep, x), out.x.data() + knot * kKnot + i);
      lanes::store(lanes::mulAdd(steps, yStep, y), out.y.data() + knot * kKnot + i);
    }
  }
}

/// Whether knots suffice for a row's path: the heading bends most where the ray is nearest to the zenith.
bool nearlyStraight(const Panorama& panorama, const RowOfRays& row) {
  constexpr float kMaxBend = 0.65F / 8.0F;  // of the arc tangent, per squared step
  const float step = kKnot * row.sideStep;
  const float texels = static_cast<float>(panorama.width()) * 0.5F * std::numbers::inv_pi_v<float>;
  return row.ahead > 0.0F && kMaxBend * step * step * texels < kBend * row.ahead * row.ahead;
}

using PixelTag = hn::RebindToUnsigned<lanes::IntTag>;
using HalfTag = hn::Repartition<std::uint16_t, PixelTag>;
using Pixels = hn::Vec<PixelTag>;
using Halves = hn::Vec<HalfTag>;

/// Mixes each channel: `weight` 256ths of `b` and the rest of `a`. Both halves of `weight` hold the weight.
HWY_INLINE Pixels mixTexels(Pixels a, Pixels b, Halves weight) {
  const HalfTag tag;
  const auto mixed = [&](Halves from, Halves to) {
    const Halves sum = hn::Add(hn::ShiftLeft<8>(from), hn::Mul(hn::Sub(to, from), weight));
    return hn::Add(sum, hn::Set(tag, 0x80));
  };
  const Halves even = hn::Set(tag, 0xFF);
  const Halves left = hn::BitCast(tag, a);
  const Halves right = hn::BitCast(tag, b);
  const Halves low = hn::ShiftRight<8>(mixed(hn::And(left, even), hn::And(right, even)));
  const Halves high = hn::AndNot(even, mixed(hn::ShiftRight<8>(left), hn::ShiftRight<8>(right)));
  return hn::BitCast(PixelTag(), hn::Or(low, high));
}

/// The fraction in 256ths, in both halves of each pixel.
HWY_INLINE Halves weightOf(Ints place) {
  const Ints rest = place & Ints(255);
  return hn::BitCast(HalfTag(), (rest | lanes::shiftLeft<16>(rest)).raw);
}

/// The four texels around each position of a vector.
struct Corners {
  Pixels left, right, leftAbove, rightAbove;
};

/// Single loads of two adjacent texels each.
HWY_INLINE Corners pick(const std::uint32_t* texels, int stride, Ints at) {
  HWY_ALIGN std::int32_t index[kLanes];
  HWY_ALIGN std::uint32_t low[2 * kLanes];
  HWY_ALIGN std::uint32_t high[2 * kLanes];
  lanes::store(at, index);
  for (int lane = 0; lane < kLanes; ++lane) {
    std::memcpy(low + 2 * lane, texels + index[lane], sizeof(std::uint64_t));
    std::memcpy(high + 2 * lane, texels + index[lane] + stride, sizeof(std::uint64_t));
  }
  const PixelTag tag;
  Corners corners;
  hn::LoadInterleaved2(tag, low, corners.left, corners.right);
  hn::LoadInterleaved2(tag, high, corners.leftAbove, corners.rightAbove);
  return corners;
}

struct Map {
  const std::uint32_t* texels;
  int stride;
  int width;
  int last;  // last row, in 256ths

  explicit Map(const Panorama& panorama)
      : texels(panorama.texels()),
        stride(panorama.stride()),
        width(panorama.width()),
        last((panorama.height() - 2) * 256 + 255) {}

  HWY_INLINE Pixels lookUp(Floats column, Floats row) const {
    const Ints x = lanes::truncate(column * 256.0F);
    const Ints y = lanes::min(lanes::truncate(row * 256.0F), Ints(last));
    const Ints turned = lanes::shiftRight<8>(x);
    const Ints around = turned - lanes::onlyWhere(turned > Ints(width - 1), Ints(width));
    const Ints at = lanes::shiftRight<8>(y) * Ints(stride) + lanes::min(around, Ints(width - 1));
    const Corners corners = pick(texels, stride, at);
    const Halves xWeight = weightOf(x);
    const Pixels low = mixTexels(corners.left, corners.right, xWeight);
    const Pixels high = mixTexels(corners.leftAbove, corners.rightAbove, xWeight);
    return hn::Or(mixTexels(low, high, weightOf(y)), hn::Set(PixelTag(), 0xFF000000U));
  }
};

/// Looks up the positions from `begin` to before `end` by whole vectors; stores only the requested ones.
HWY_INLINE void lookUp(const Map& map, const Places& places, int begin, int end, std::uint32_t* HWY_RESTRICT colour) {
  const PixelTag tag;
  for (int i = begin / kLanes * kLanes; i < end; i += kLanes) {
    const Pixels pixels = map.lookUp(lanes::load(places.x.data() + i), lanes::load(places.y.data() + i));
    if (i >= begin && i + kLanes <= end) {
      hn::StoreU(pixels, tag, colour + (i - begin));
    } else {
      HWY_ALIGN std::uint32_t some[kLanes];
      hn::Store(pixels, tag, some);
      const int first = std::max(i, begin);
      std::copy_n(some + (first - i), std::min(i + kLanes, end) - first, colour + (first - begin));
    }
  }
}

void sampleRow(const Panorama& panorama, const RowOfRays& rays, int first, int count, std::uint32_t* colour) {
  const bool straight = nearlyStraight(panorama, rays);
  const Map map(panorama);
  Places knots;
  Places places;
  for (int chunk = floorTo(first, kChunk); chunk < first + count; chunk += kChunk) {
    if (straight) {
      aim(panorama, rays, chunk, kKnot, kChunk / kKnot + 1, knots);
      joinKnots(knots, places);
    } else {
      aim(panorama, rays, chunk, 1, kChunk, places);
    }
    const int begin = std::max(first, chunk);
    const int end = std::min(first + count, chunk + kChunk);
    lookUp(map, places, begin - chunk, end - chunk, colour + (begin - first));
  }
}

/// mixTexels() for one pixel, for loops that the compiler vectorises.
HWY_INLINE std::uint32_t mixTexel(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  constexpr std::uint32_t kEven = 0x00FF00FFU;
  const auto mixed = [&](std::uint32_t from, std::uint32_t to) {
    return from * 256U + (to - from) * weight + 0x00800080U;
  };
  const std::uint32_t low = (mixed(a & kEven, b & kEven) >> 8U) & kEven;
  const std::uint32_t high = mixed((a >> 8U) & kEven, (b >> 8U) & kEven) & ~kEven;
  return low | high;
}

template <unsigned kStep>
void widen(const std::uint32_t* HWY_RESTRICT above, const std::uint32_t* HWY_RESTRICT below, int count,
           std::uint32_t* HWY_RESTRICT colour) {
  const int steps = (count + static_cast<int>(kStep) - 1) / static_cast<int>(kStep);
  for (int i = 0; i < steps; ++i) {
    const std::uint32_t left = mixTexel(above[i], below[i], 128U);
    const std::uint32_t right = mixTexel(above[i + 1], below[i + 1], 128U);
    std::uint32_t* HWY_RESTRICT out = colour + i * static_cast<int>(kStep);
    out[0] = left;
    for (unsigned j = 1; j < kStep; ++j) out[j] = mixTexel(left, right, 256U / kStep * j);
  }
}

void widenRow(const std::uint32_t* above, const std::uint32_t* below, int step, int count, std::uint32_t* colour) {
  if (step == 2) {
    widen<2>(above, below, count, colour);
  } else {
    widen<4>(above, below, count, colour);
  }
}

}  // namespace
}  // namespace grove::objects::sky::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::sky {

HWY_EXPORT(sampleRow);
HWY_EXPORT(widenRow);

void sampleRow(const Panorama& panorama, const RowOfRays& rays, int first, int count, std::uint32_t* colour) {
  HWY_DYNAMIC_DISPATCH(sampleRow)(panorama, rays, first, count, colour);
}

void widenRow(const std::uint32_t* above, const std::uint32_t* below, int step, int count, std::uint32_t* colour) {
  HWY_DYNAMIC_DISPATCH(widenRow)(above, below, step, count, colour);
}

}  // namespace grove::objects::sky

#endif  // HWY_ONCE
