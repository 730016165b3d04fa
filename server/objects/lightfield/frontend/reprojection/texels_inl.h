// Look-ups in a cached view. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_FRONTEND_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_FRONTEND_TEXELS_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_FRONTEND_TEXELS_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_FRONTEND_TEXELS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "base/simd/row_part_inl.h"
#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/frontend/reprojection/reprojection_tile.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

using namespace grove::simd::HWY_NAMESPACE;

/// Left and top bounds of the texels of adjacent pixels, or one of those texels.
struct Corner {
  int column;
  int row;
};

/// A view's texels in the form that the loops need.
struct Texels {
  const float* nearness;
  int stride;
  int rows;
  float softness;
  float limitX;
  float limitY;
  world::Vec3 m;

  Texels(const CachedView& view, const ViewWarp& warp)
      : nearness(view.nearness()),
        stride(view.width()),
        rows(view.height()),
        softness(view.softness()),
        // The last column and row are for bilinear look-ups only.
        limitX(static_cast<float>(view.width()) - 1.001F),
        limitY(static_cast<float>(view.height()) - 1.001F),
        m(warp.m) {}

  /// Converts values of CachedView::nearness() to 1 / depth.
  HWY_INLINE Floats nearnessOf(Floats ranked) const { return select(ranked < 0.0F, ranked + softness, ranked); }

  /// CachedView::nearness() of these texels; fast if they are near the corner.
  HWY_INLINE Floats rankedNear(const Corner& corner, Ints column, Ints row) const;
};

/// A vector of adjacent rays in a row of a tile.
struct Rays {
  Floats a0;
  Floats a1;
  float cornerA0;  ///< the smaller a0 of the first and the last ray
  float cornerA1;  ///< the smaller a1 of the first and the last ray

  HWY_INLINE Rays(const WarpTile& tile, int first)
      : a0(load(tile.a0 + first)),
        a1(load(tile.a1 + first)),
        cornerA0(lower(tile.a0 + first)),
        cornerA1(lower(tile.a1 + first)) {}

  /// CachedView::nearness() at the rays' positions for nearness `w`.
  HWY_INLINE Floats ranked(const Texels& texels, float w) const { return at(texels, w, cornerAt(texels, w)); }
  /// The same with one `w` per ray, each between `least` and `greatest`.
  HWY_INLINE Floats ranked(const Texels& texels, Floats w, float min, float max) const {
    const Corner a = cornerAt(texels, min);
    const Corner b = cornerAt(texels, max);
    return at(texels, w, {a.column < b.column ? a.column : b.column, a.row < b.row ? a.row : b.row});
  }

 private:
  static HWY_INLINE float lower(const float* a) { return a[0] < a[kLanes - 1] ? a[0] : a[kLanes - 1]; }
  static HWY_INLINE int texel(float place, float limit) {
    const float low = place > 0.0F ? place : 0.0F;
    return static_cast<int>(low < limit ? low : limit);
  }
  HWY_INLINE Corner cornerAt(const Texels& texels, float w) const {
    const float scale = 1.0F - texels.m.z * w;
    return {texel(cornerA0 * scale + texels.m.x * w, texels.limitX),
            texel(cornerA1 * scale + texels.m.y * w, texels.limitY)};
  }
  HWY_INLINE Floats at(const Texels& texels, Floats w, const Corner& corner) const {
    const Floats scale = 1.0F - texels.m.z * w;
    const Floats x = clamp(mulAdd(a0, scale, texels.m.x * w), 0.0F, texels.limitX);
    const Floats y = clamp(mulAdd(a1, scale, texels.m.y * w), 0.0F, texels.limitY);
    return texels.rankedNear(corner, truncate(x), truncate(y));
  }
};

#if GROVE_SIMD_PERMUTES
/// Adjacent pixels use adjacent texels: most are in two registers of each of a few rows.
HWY_INLINE Floats Texels::rankedNear(const Corner& corner, Ints column, Ints row) const {
  constexpr int kRows = kLanes == 16 ? 3 : 2;
  const Ints right = column - corner.column;
  const Ints down = row - corner.row;
  // Arithmetic shifts.
  const Ints outside = hn::Or(hn::ShiftRight<(kLanes == 16 ? 5 : 4)>(right.raw), hn::ShiftRight<2>(down.raw));
  if (HWY_UNLIKELY(any((outside != 0) | (down > kRows - 1)))) return lookUp(nearness, row * stride + column);
  const auto among = [&](int line) {
    return Floats(RowPart<FloatTag>(nearness + std::ptrdiff_t{corner.row + line} * stride + corner.column).at(right));
  };
  const Floats found = select(down == 1, among(1), among(0));
  if constexpr (kRows == 2) return found;
  const Mask isThird = down == 2;
  return HWY_LIKELY(!any(isThird)) ? found : select(isThird, among(2), found);
}
#else
HWY_INLINE Floats Texels::rankedNear(const Corner&, Ints column, Ints row) const {
  return lookUp(nearness, row * stride + column);
}
#endif

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
