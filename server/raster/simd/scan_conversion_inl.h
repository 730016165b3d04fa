// Computes the pixels that a triangle covers: those with centres inside, or on its left or upper edge. Only for exact
// kernels (GroveTargets.cmake): both triangles of an edge intersect it with a row in the same way, so that there are no
// gaps, which requires that all code rounds equally.

#if defined(GROVE_RASTER_SIMD_SCAN_CONVERSION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_RASTER_SIMD_SCAN_CONVERSION_INL_H
#undef GROVE_RASTER_SIMD_SCAN_CONVERSION_INL_H
#else
#define GROVE_RASTER_SIMD_SCAN_CONVERSION_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/simd/lanes_inl.h"
#include "world/camera.h"

HWY_BEFORE_NAMESPACE();
namespace grove::raster::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): one word for each operation

struct ScreenPoint {
  float x;  ///< pixels
  float y;
};

/// Rows per conversion.
constexpr int kScanRows = 16;

/// By row, the columns from `begin` to before `end`; none if end <= begin.
struct ScanRows {
  HWY_ALIGN std::int32_t begin[kScanRows];
  HWY_ALIGN std::int32_t end[kScanRows];
};

struct ScanEdge {
  HWY_INLINE ScanEdge(ScreenPoint from, ScreenPoint to)
      : x(from.x), top(from.y), slope(to.y > from.y ? (to.x - from.x) / (to.y - from.y) : 0.0F) {}
  float x;
  float top;
  float slope;
};

class ScanConverter {
 public:
  /// For the triangle's part within `limits`. The corners are sorted from top to bottom.
  HWY_INLINE ScanConverter(ScreenPoint first, ScreenPoint second, ScreenPoint third, const world::Rect& limits)
      : long_(first, third),
        upper_(first, second),
        lower_(second, third),
        longIsLeft_((second.x - first.x) * (third.y - first.y) > (third.x - first.x) * (second.y - first.y)),
        low_(static_cast<float>(limits.left)),
        high_(static_cast<float>(limits.right)) {
    const auto rowFrom = [&](float y) {
      const auto top = static_cast<float>(limits.top);
      const auto bottom = static_cast<float>(limits.bottom);
      return static_cast<int>(std::ceil(std::min(std::max(y - 0.5F, top), bottom)));
    };
    top_ = rowFrom(first.y);
    middle_ = rowFrom(second.y);
    bottom_ = rowFrom(third.y);
  }

  [[nodiscard]] HWY_INLINE int top() const { return top_; }
  [[nodiscard]] HWY_INLINE int bottom() const { return bottom_; }

  /// Converts `count` rows, at most kScanRows, from `first` on; entries beyond them are undefined.
  HWY_INLINE void convert(int first, int count, ScanRows& rows) const {
    std::int32_t* straight = longIsLeft_ ? rows.begin : rows.end;
    std::int32_t* bent = longIsLeft_ ? rows.end : rows.begin;
    for (int i = 0; i < count; i += kLanes) {
      const Ints row = upwards() + (first + i);
      const Floats y = toFloats(row) + 0.5F;
      const Mask isUpper = row < Ints(middle_);
      const auto bentEdge = [&](float upper, float lower) { return select(isUpper, Floats(upper), Floats(lower)); };
      store(columns(y, long_.x, long_.top, long_.slope), straight + i);
      store(columns(y, bentEdge(upper_.x, lower_.x), bentEdge(upper_.top, lower_.top),
                    bentEdge(upper_.slope, lower_.slope)),
            bent + i);
    }
  }

 private:
  /// The first column whose centre is not before the edge's intersection with the centre of a row.
  HWY_INLINE Ints columns(Floats y, Floats x, Floats top, Floats slope) const {
    return truncate(Floats(hn::Ceil(clamp(x + (y - top) * slope - 0.5F, low_, high_).raw)));
  }

  ScanEdge long_;
  ScanEdge upper_;
  ScanEdge lower_;
  bool longIsLeft_;
  float low_;  // columns
  float high_;
  int top_;
  int middle_;  // first row of the lower edge
  int bottom_;
};

}  // namespace grove::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
