#include "objects/lightfield/backend/near/near_canvas_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/backend/near/near_canvas_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster/simd/scan_conversion_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using raster::HWY_NAMESPACE::kScanRows;
using raster::HWY_NAMESPACE::ScanConverter;
using raster::HWY_NAMESPACE::ScanRows;

/// Rows of most triangles are narrower than the widest vectors.
using SampleTag = hn::CappedTag<float, 8>;
using SampleBits = hn::RebindToSigned<SampleTag>;
using Samples = hn::Vec<SampleTag>;
constexpr int kSampleLanes = static_cast<int>(hn::MaxLanes(SampleTag()));
static_assert(kNearTileWidth % kSampleLanes == 0);

HWY_INLINE Samples clampTo(Samples value, float low, float high) {
  return hn::Min(hn::Max(value, hn::Set(SampleTag(), low)), hn::Set(SampleTag(), high));
}

/// One colour for a whole triangle.
class FlatColour {
 public:
  HWY_INLINE explicit FlatColour(std::uint32_t colour)
      : colour_(hn::Set(SampleBits(), static_cast<std::int32_t>(colour))) {}
  HWY_INLINE hn::Vec<SampleBits> at(Samples /*x*/, float /*y*/) const { return colour_; }

 private:
  hn::Vec<SampleBits> colour_;
};

/// Colours interpolated between a triangle's corners on the screen: triangles are so small that perspective makes no
/// visible difference within one.
class SmoothColour {
 public:
  HWY_INLINE explicit SmoothColour(const ScreenTriangle& t) : x_(t.x[0]), y_(t.y[0]) {
    const float abx = t.x[1] - t.x[0];
    const float aby = t.y[1] - t.y[0];
    const float acx = t.x[2] - t.x[0];
    const float acy = t.y[2] - t.y[0];
    const float perArea = 1.0F / (abx * acy - acx * aby);
    for (unsigned c = 0; c < 3; ++c) {
      const auto value = [&](std::size_t corner) {
        return static_cast<float>(static_cast<std::int32_t>((t.colour[corner] >> (8U * c)) & 0xFFU));
      };
      const float ab = (value(1) - value(0)) * perArea;
      const float ac = (value(2) - value(0)) * perArea;
      first_[c] = value(0);
      alongX_[c] = ab * acy - ac * aby;
      alongY_[c] = ac * abx - ab * acx;
    }
  }

  HWY_INLINE hn::Vec<SampleBits> at(Samples x, float y) const {
    const SampleTag tag;
    const SampleBits bits;
    const auto right = hn::Sub(x, hn::Set(tag, x_));
    const auto channel = [&](std::size_t c) {
      const auto inRow = hn::Set(tag, first_[c] + alongY_[c] * (y - y_));
      const auto value = clampTo(hn::MulAdd(right, hn::Set(tag, alongX_[c]), inRow), 0.0F, 255.0F);
      return hn::And(hn::BitCast(bits, hn::Add(value, hn::Set(tag, kInteger))), hn::Set(bits, 0xFF));
    };
    return hn::Or(hn::Or(channel(0), hn::Set(bits, static_cast<std::int32_t>(0xFF000000U))),
                  hn::Or(hn::ShiftLeft<8>(channel(1)), hn::ShiftLeft<16>(channel(2))));
  }

 private:
  /// A sum with this has the whole number in its lowest bits.
  static constexpr float kInteger = 8388608.0F;

  float x_;
  float y_;
  float first_[3];
  float alongX_[3];
  float alongY_[3];
};

/// Draws the samples at `at` of which `inside` is true and which nothing nearer covers.
HWY_INLINE void fill(Samples nearness, hn::Mask<SampleTag> inside, hn::Vec<SampleBits> colour, std::ptrdiff_t at,
                     NearCanvas& canvas) {
  const SampleTag tag;
  const SampleBits bits;
  float* const nearnessTo = canvas.nearness.data() + at;
  auto* const colourTo = reinterpret_cast<std::int32_t*>(canvas.colours.data() + at);
  const auto before = hn::LoadU(tag, nearnessTo);
  const auto shown = hn::And(inside, hn::Gt(nearness, before));
  hn::StoreU(hn::IfThenElse(shown, nearness, before), tag, nearnessTo);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(bits, shown), colour, hn::LoadU(bits, colourTo)), bits, colourTo);
}

// By value: the compiler cannot tell that the canvas's samples are not the triangle's.
template <class Colour>
HWY_INLINE void drawTriangle(ScreenTriangle t, Colour colour, int left, int top, NearCanvas& canvas) {
  const SampleTag tag;
  const ScanConverter scan({t.x[0], t.y[0]}, {t.x[1], t.y[1]}, {t.x[2], t.y[2]},
                           {left, top, left + kNearTileWidth, top + kNearTileHeight});
  ScanRows rows;
  for (int first = scan.top(); first < scan.bottom(); first += kScanRows) {
    const int count = std::min(kScanRows, scan.bottom() - first);
    scan.convert(first, count, rows);
    for (int i = 0; i < count; ++i) {
      const int begin = rows.begin[i];
      const int end = rows.end[i];
      if (begin >= end) continue;
      const float y = static_cast<float>(first + i) + 0.5F;
      const float inRow = t.nearness + t.alongY * (y - t.y[0]) - t.alongX * t.x[0];
      const std::ptrdiff_t row = std::ptrdiff_t{first + i - top} * kNearStride - left;
      // Vectors at fixed columns: a load that overlaps two earlier stores would wait for both.
      for (int x = begin & -kSampleLanes; x < end; x += kSampleLanes) {
        const auto lane = hn::Iota(tag, static_cast<float>(x));
        const auto inside = hn::And(hn::Ge(lane, hn::Set(tag, static_cast<float>(begin))),
                                    hn::Lt(lane, hn::Set(tag, static_cast<float>(end))));
        const auto middle = hn::Add(lane, hn::Set(tag, 0.5F));
        // A sliver's plane is too steep for floats.
        const auto nearness = clampTo(hn::MulAdd(middle, hn::Set(tag, t.alongX), hn::Set(tag, inRow)), t.low, t.high);
        fill(nearness, inside, colour.at(middle, y), row + x, canvas);
      }
    }
  }
}

void drawTile(std::span<const ScreenTriangle> triangles, int left, int top, NearCanvas& canvas) {
  for (const ScreenTriangle& t : triangles) {
    if (t.colour[0] == t.colour[1] && t.colour[0] == t.colour[2]) {
      drawTriangle(t, FlatColour(t.colour[0]), left, top, canvas);
    } else {
      drawTriangle(t, SmoothColour(t), left, top, canvas);
    }
  }
}

using ResolveTag = hn::CappedTag<std::uint32_t, 8>;
using ResolveFloats = hn::RebindToFloat<ResolveTag>;
constexpr int kResolveLanes = static_cast<int>(hn::MaxLanes(ResolveTag()));

/// Mixes haze into colours whose bytes are apart, in steps of 1 / 256.
class HazeMix {
 public:
  HWY_INLINE explicit HazeMix(const Haze& haze) {
    const auto of = [](float share) { return static_cast<std::uint32_t>(std::lround(256.0F * share)); };
    const std::uint32_t kept = of(1.0F - haze.amount);
    // Rounded sums must not exceed 256, since a product has 16 bits.
    const auto added = [&](std::size_t channel) {
      return std::min(of(haze.colour[channel] * haze.amount), of(1.0F) - kept);
    };
    keptEven_ = kept << 16U | kept;
    keptOdd_ = of(1.0F) << 16U | kept;  // coverage stays
    addedEven_ = added(2) << 16U | added(0);
    addedOdd_ = added(1);
  }

  /// The colours with bytes R, B in `even` and G, A in `odd`, each as 16 bits.
  HWY_INLINE hn::Vec<ResolveTag> mixed(hn::Vec<ResolveTag> even, hn::Vec<ResolveTag> odd) const {
    const ResolveTag tag;
    const auto alpha = hn::ShiftRight<16>(odd);
    const auto alphas = hn::Or(alpha, hn::ShiftLeft<16>(alpha));
    const auto mix = [&](hn::Vec<ResolveTag> bytes, std::uint32_t kept, std::uint32_t added) {
      const hn::Repartition<std::uint16_t, ResolveTag> words;
      const auto times = [&](hn::Vec<ResolveTag> a, std::uint32_t b) {
        return hn::Mul(hn::BitCast(words, a), hn::BitCast(words, hn::Set(tag, b)));
      };
      const auto sum = hn::Add(hn::Add(times(bytes, kept), times(alphas, added)), hn::Set(words, 128));
      return hn::BitCast(tag, hn::ShiftRight<8>(sum));
    };
    return hn::Or(mix(even, keptEven_, addedEven_), hn::ShiftLeft<8>(mix(odd, keptOdd_, addedOdd_)));
  }

 private:
  std::uint32_t keptEven_;
  std::uint32_t keptOdd_;
  std::uint32_t addedEven_;
  std::uint32_t addedOdd_;
};

/// The mean of the colours of 2 x 2 samples behind haze, for a vector of pixels.
HWY_INLINE hn::Vec<ResolveTag> meanColour(const std::uint32_t* upper, const std::uint32_t* lower, const HazeMix& haze) {
  const ResolveTag tag;
  const auto evenBytes = hn::Set(tag, 0x00FF00FFU);
  hn::Vec<ResolveTag> a, b, c, d;
  hn::LoadInterleaved2(tag, upper, a, b);
  hn::LoadInterleaved2(tag, lower, c, d);
  const auto mean = [&](const auto& bytesOf) {
    const auto sum = hn::Add(hn::Add(bytesOf(a), bytesOf(b)), hn::Add(bytesOf(c), bytesOf(d)));
    return hn::And(hn::ShiftRight<2>(hn::Add(sum, hn::Set(tag, 0x00020002U))), evenBytes);
  };
  const auto even = mean([&](hn::Vec<ResolveTag> v) { return hn::And(v, evenBytes); });
  const auto odd = mean([&](hn::Vec<ResolveTag> v) { return hn::And(hn::ShiftRight<8>(v), evenBytes); });
  return haze.mixed(even, odd);
}

/// The least depth of 2 x 2 samples.
HWY_INLINE hn::Vec<ResolveFloats> nearestDepth(const float* upper, const float* lower) {
  const ResolveFloats tag;
  hn::Vec<ResolveFloats> a, b, c, d;
  hn::LoadInterleaved2(tag, upper, a, b);
  hn::LoadInterleaved2(tag, lower, c, d);
  const auto nearest = hn::Max(hn::Max(a, b), hn::Max(c, d));
  return hn::IfThenElse(hn::Gt(nearest, hn::Zero(tag)), hn::Div(hn::Set(tag, 1.0F), nearest),
                        hn::Set(tag, world::kInfiniteDepth));
}

void resolveTile(int left, int top, const Haze& haze, NearCanvas& canvas, raster::Image& image) {
  static_assert(kNearSamples == 2);
  const ResolveTag tag;
  const ResolveFloats floats;
  const HazeMix hazeMix(haze);
  const int width = std::min(kNearTileWidth / 2, image.width() - left);
  const int height = std::min(kNearTileHeight / 2, image.height() - top);
  HWY_ALIGN std::uint32_t colours[kNearTileWidth / 2];
  HWY_ALIGN float depths[kNearTileWidth / 2];
  for (int y = 0; y < height; ++y) {
    const std::ptrdiff_t upper = std::ptrdiff_t{2} * y * kNearStride;
    const std::ptrdiff_t lower = upper + kNearStride;
    for (int x = 0; x < width; x += kResolveLanes) {
      const std::uint32_t* const colour = canvas.colours.data() + 2 * x;
      const float* const nearness = canvas.nearness.data() + 2 * x;
      hn::Store(meanColour(colour + upper, colour + lower, hazeMix), tag, colours + x);
      hn::Store(nearestDepth(nearness + upper, nearness + lower), floats, depths + x);
    }
    std::copy_n(colours, width, image.colourRow(top + y) + left);
    std::copy_n(depths, width, image.depthRow(top + y) + left);
  }
  std::ranges::fill(canvas.colours, 0U);
  std::ranges::fill(canvas.nearness, 0.0F);
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(drawTile);
HWY_EXPORT(resolveTile);

void drawTile(std::span<const ScreenTriangle> triangles, int left, int top, NearCanvas& canvas) {
  HWY_DYNAMIC_DISPATCH(drawTile)(triangles, left, top, canvas);
}

void resolveTile(int left, int top, const Haze& haze, NearCanvas& canvas, raster::Image& image) {
  HWY_DYNAMIC_DISPATCH(resolveTile)(left, top, haze, canvas, image);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
