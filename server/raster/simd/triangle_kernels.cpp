#include "raster/simd/triangle_kernels.h"

#include <algorithm>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/simd/triangle_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster/simd/scan_conversion_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::raster::HWY_NAMESPACE {

/// All values of a Corner: x, y, then the values that are linear on the screen.
constexpr std::size_t kPlanes = sizeof(Corner) / sizeof(float);
constexpr std::size_t kFirstPlane = 2;
using PlaneTag = hn::CappedTag<float, kPlanes>;
constexpr std::size_t kPlaneLanes = hn::MaxLanes(PlaneTag());
constexpr std::size_t kParts = kPlanes / kPlaneLanes;
static_assert(kParts * kPlaneLanes == kPlanes);

/// All planes at one pixel, or their change per pixel.
struct Planes {
  hn::Vec<PlaneTag> part[kParts];
};

HWY_INLINE Planes planesOf(const Corner& corner) {
  Planes planes;
  for (std::size_t i = 0; i < kParts; ++i) {
    planes.part[i] = hn::LoadU(PlaneTag(), reinterpret_cast<const float*>(&corner) + i * kPlaneLanes);
  }
  return planes;
}

/// a * x + b * y.
HWY_INLINE Planes combined(const Planes& a, float x, const Planes& b, float y) {
  Planes sum;
  for (std::size_t i = 0; i < kParts; ++i) {
    sum.part[i] = hn::MulAdd(a.part[i], hn::Set(PlaneTag(), x), hn::Mul(b.part[i], hn::Set(PlaneTag(), y)));
  }
  return sum;
}

HWY_INLINE Planes operator+(const Planes& a, const Planes& b) {
  Planes sum;
  for (std::size_t i = 0; i < kParts; ++i) sum.part[i] = hn::Add(a.part[i], b.part[i]);
  return sum;
}

HWY_INLINE Planes operator-(const Planes& a, const Planes& b) {
  Planes difference;
  for (std::size_t i = 0; i < kParts; ++i) difference.part[i] = hn::Sub(a.part[i], b.part[i]);
  return difference;
}

HWY_INLINE void store(const Planes& planes, float* to) {
  for (std::size_t i = 0; i < kParts; ++i) hn::Store(planes.part[i], PlaneTag(), to + i * kPlaneLanes);
}

/// Most rows of most triangles are narrower than the widest vectors, which then cost more than they gain.
using PixelTag = hn::CappedTag<float, 8>;
using PixelBits = hn::RebindToSigned<PixelTag>;
using Pixels = hn::Vec<PixelTag>;
constexpr int kPixelLanes = static_cast<int>(hn::MaxLanes(PixelTag()));

HWY_INLINE Pixels held(Pixels value, float low, float high) {
  return hn::Min(hn::Max(value, hn::Set(PixelTag(), low)), hn::Set(PixelTag(), high));
}

/// Accurate to at least 16 bits.
HWY_INLINE Pixels reciprocal(Pixels value) {
  const Pixels guess = hn::ApproximateReciprocal(value);
  return hn::Mul(guess, hn::NegMulAdd(value, guess, hn::Set(PixelTag(), 2.0F)));
}

static_assert(kPixelLanes <= static_cast<int>(kFragmentRoom));

/// Draws one triangle's pixels.
class Filler {
 public:
  /// Depths are clamped to a range.
  HWY_INLINE Filler(const Planes& alongX, float low, float high) : low_(low), high_(high) {
    const PixelTag tag;
    HWY_ALIGN float slope[kPlanes];
    store(alongX, slope);
    for (std::size_t k = kFirstPlane; k < kPlanes; ++k) {
      lanes_[k] = hn::Mul(hn::Iota(tag, 0.0F), hn::Set(tag, slope[k]));
    }
  }

  /// The first `count` pixels of a vector; `at` holds the planes at the first pixel.
  HWY_INLINE void fill(const float* at, int count, std::uint32_t* surface, float* depth) const {
    const PixelTag tag;
    const PixelBits bits;
    const auto plane = [&](std::size_t k) { return hn::Add(lanes_[k], hn::Set(tag, at[k])); };
    // A sliver's planes are too steep for floats, so their values are clamped to the triangle's range.
    const Pixels reversed = held(plane(2), low_, high_);
    const Pixels before = hn::LoadU(tag, depth);
    const auto shown = hn::And(hn::Gt(reversed, before), hn::FirstN(tag, static_cast<std::size_t>(count)));
    const Pixels scale = reciprocal(reversed);
    // Rounds: a sum with 2^23 has the whole number in its lowest bits; the upper bits are undefined.
    const auto shade = [&](std::size_t k, float top) {
      return hn::BitCast(bits, hn::Add(held(hn::Mul(plane(k), scale), 0.0F, top), hn::Set(tag, 8388608.0F)));
    };
    const auto red = hn::And(shade(3, 255.0F), hn::Set(bits, 0xFF));
    const auto greenBlue = hn::Or(hn::ShiftLeft<8>(shade(4, 255.0F)), hn::ShiftLeft<16>(shade(5, 255.0F)));
    const auto material = hn::Or(hn::ShiftLeft<24>(shade(7, 15.0F)), hn::ShiftLeft<28>(shade(6, 15.0F)));
    const auto packed = hn::Or(red, hn::Or(greenBlue, material));
    auto* packedTo = reinterpret_cast<std::int32_t*>(surface);
    const auto packedBefore = hn::LoadU(bits, packedTo);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(bits, shown), packed, packedBefore), bits, packedTo);
    hn::StoreU(hn::IfThenElse(shown, reversed, before), tag, depth);
  }

 private:
  Pixels lanes_[kPlanes];  // the planes' change from the first pixel of a vector to each
  float low_;
  float high_;
};

/// Prefetches the pixels of a column, whose rows are far apart.
HWY_INLINE void prefetch(Canvas& canvas, int column, int top, int bottom) {
  const int x = std::clamp(column, canvas.rect.left, canvas.rect.right - 1) - canvas.rect.left;
  for (int y = top; y < bottom; ++y) {
    const std::ptrdiff_t at = (y - canvas.rect.top) * canvas.stride + x;
    __builtin_prefetch(canvas.depth.data() + at, 1);
    __builtin_prefetch(canvas.surface.data() + at, 1);
  }
}

HWY_INLINE void drawTriangle(const Corner& a, const Corner& b, const Corner& c, Canvas& canvas) {
  const float abx = b.x - a.x;
  const float aby = b.y - a.y;
  const float acx = c.x - a.x;
  const float acy = c.y - a.y;
  const float twiceArea = abx * acy - acx * aby;
  // Counter-clockwise from outside, but the screen's y grows downwards.
  if (twiceArea >= 0.0F) return;
  ScreenPoint first{a.x, a.y};
  ScreenPoint second{b.x, b.y};
  ScreenPoint third{c.x, c.y};
  if (second.y < first.y) std::swap(first, second);
  if (third.y < second.y) std::swap(second, third);
  if (second.y < first.y) std::swap(first, second);
  const ScanConverter scan(first, second, third, canvas.rect);
  if (scan.top() >= scan.bottom()) return;
  prefetch(canvas, static_cast<int>(first.x), scan.top(), std::min(scan.top() + kScanRows, scan.bottom()));
  const float perArea = 1.0F / twiceArea;
  const Planes atA = planesOf(a);
  const Planes ab = planesOf(b) - atA;
  const Planes ac = planesOf(c) - atA;
  const Planes alongX = combined(ab, acy * perArea, ac, -aby * perArea);
  const Planes alongY = combined(ac, abx * perArea, ab, -acx * perArea);
  const Filler filler(alongX, std::min(std::min(a.planes[0], b.planes[0]), c.planes[0]),
                      std::max(std::max(a.planes[0], b.planes[0]), c.planes[0]));
  HWY_ALIGN float at[kPlanes];
  ScanRows rows;
  for (int top = scan.top(); top < scan.bottom(); top += kScanRows) {
    const int count = std::min(kScanRows, scan.bottom() - top);
    scan.convert(top, count, rows);
    for (int i = 0; i < count; ++i) {
      const int begin = rows.begin[i];
      const int end = rows.end[i];
      if (begin >= end) continue;
      const std::ptrdiff_t row = top + i - canvas.rect.top;
      Span& span = canvas.spans[static_cast<std::size_t>(row)];
      span.begin = std::min(span.begin, begin - canvas.rect.left);
      span.end = std::max(span.end, end - canvas.rect.left);
      const std::ptrdiff_t start = row * canvas.stride - canvas.rect.left;
      const float down = static_cast<float>(top + i) + 0.5F - a.y;
      for (int x = begin; x < end; x += kPixelLanes) {
        store(atA + combined(alongX, static_cast<float>(x) + 0.5F - a.x, alongY, down), at);
        filler.fill(at, std::min(kPixelLanes, end - x), canvas.surface.data() + start + x,
                    canvas.depth.data() + start + x);
      }
    }
  }
}

void drawTriangles(std::span<const Triangle> triangles, std::span<const Corner> corners, Canvas& canvas) {
  for (const Triangle& triangle : triangles) {
    drawTriangle(corners[triangle[0]], corners[triangle[1]], corners[triangle[2]], canvas);
  }
}

}  // namespace grove::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::raster {

HWY_EXPORT(drawTriangles);

void drawTriangles(std::span<const Triangle> triangles, std::span<const Corner> corners, Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(drawTriangles)(triangles, corners, canvas);
}

}  // namespace grove::raster

#endif  // HWY_ONCE
