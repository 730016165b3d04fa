// Interpolates the views. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_BLEND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_BLEND_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_BLEND_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_BLEND_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdlib>

#include "base/simd/look_up_inl.h"
#include "objects/lightfield/backend/simd/texel_window_inl.h"
#include "objects/lightfield/backend/simd/tile_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::simd::HWY_NAMESPACE {

/// Sums over the views: premultiplied bytes and their weight.
struct Blended {
  Plane<Floats> red, green, blue, coverage, weight;
};

/// Interpolates each pixel's four nearest views where they see its point, 4 texels of colour and depth each.
class Blend {
 public:
  Blend(const LightField& field, int level, int lighting, Lenses& lenses)
      : field_(field), level_(level), lighting_(lighting), lenses_(lenses) {}

  /// Only pixels with found set. Ignores depth for pixels with guessed set.
  [[nodiscard]] const Blended& run(const Tile& tile) {
    sum_ = {};
    Extent alongU;
    Extent alongV;
    for (std::size_t g = 0; g < kGroups; ++g) {
      alongU.add(tile.u[g], tile.found[g]);
      alongV.add(tile.v[g], tile.found[g]);
    }
    if (alongU.low() > alongU.high()) return sum_;
    const int n = field_.sphere.subdivision();
    const int lastI = static_cast<int>(std::floor(alongU.high())) + 1;
    const int lastJ = static_cast<int>(std::floor(alongV.high())) + 1;
    for (int j = static_cast<int>(std::floor(alongV.low())); j <= lastJ; ++j) {
      for (int i = static_cast<int>(std::floor(alongU.low())); i <= lastI; ++i) {
        if (std::abs(i) + std::abs(j) <= n) add(tile, {i, j});
      }
    }
    return sum_;
  }

 private:
  /// A texel hides a pixel's point if it is nearer by more than this, in widths of a texel there.
  static constexpr float kAgreement = 7.0F;
  static constexpr float kMinViewDepth = 1.0e-3F;

  template <int kShift>
  static Floats byteOf(Ints texel) {
    return toFloats(shiftRight<kShift>(texel) & 0xFF);
  }

  /// Adds the view at `point` in the lattice.
  void add(const Tile& tile, ViewSphere::Point point) {
    Plane<Floats> viewWeight;
    Mask anyWeight;
    for (std::size_t g = 0; g < kGroups; ++g) {
      const Floats u = max(1.0F - abs(tile.u[g] - static_cast<float>(point.i)), 0.0F);
      const Floats v = max(1.0F - abs(tile.v[g] - static_cast<float>(point.j)), 0.0F);
      viewWeight[g] = onlyWhere(tile.found[g], u * v);
      anyWeight |= viewWeight[g] > 0.0F;
    }
    if (!any(anyWeight)) return;

    const int view = field_.sphere.view(point);
    const Lens& lens = lenses_.of(view);
    const auto last = static_cast<float>((field_.size >> level_) - 2);
    Plane<Floats> across;
    Plane<Floats> down;
    Plane<Floats> away;
    Extent columns;
    Extent rows;
    for (std::size_t g = 0; g < kGroups; ++g) {
      const Mask mask = viewWeight[g] > 0.0F;
      if (!any(mask)) continue;
      const Sight sight(tile, static_cast<int>(g), lens);
      const Floats t = tile.depth[g];
      away[g] = sight.z0 + t * sight.z1;
      const Floats inverse = 1.0F / max(away[g], kMinViewDepth);
      across[g] = clamp((sight.x0 + t * sight.x1) * inverse + lens.middle, 0.0F, last);
      down[g] = clamp((sight.y0 + t * sight.y1) * inverse + lens.middle, 0.0F, last);
      columns.add(across[g], mask);
      rows.add(down[g], mask);
    }
    const TexelBox box{static_cast<int>(columns.low()), static_cast<int>(rows.low()),
                       static_cast<int>(columns.high()) + 1, static_cast<int>(rows.high()) + 1};
    loadWindow(field_, level_, view, lighting_, box, window_);

    for (std::size_t g = 0; g < kGroups; ++g) {
      const Mask mask = viewWeight[g] > 0.0F;
      if (!any(mask)) continue;
      // Inactive pixels have no position in the view.
      const Floats x = select(mask, across[g], static_cast<float>(box.left));
      const Floats y = select(mask, down[g], static_cast<float>(box.top));
      // Nearer texels hide the point; farther and empty texels are visible beside it.
      const Floats nearest =
          (away[g] - kAgreement * lens.metresPerTexel * away[g] - lens.nearDepth) * (1.0F / lens.depthStep);
      addTexels(g, x, y, select(tile.guessed[g], 0.0F, nearest), viewWeight[g]);
    }
  }

  /// Adds a group's four texels around (x, y), except those with a stored depth below `limit`.
  void addTexels(std::size_t g, Floats x, Floats y, Floats limit, Floats viewWeight) {
    const std::uint16_t* const depths = window_.depth.data() - window_.layout.origin;
    const std::uint32_t* const colours = window_.colour.data() - window_.layout.origin;
    const int stride = window_.layout.stride;
    const Ints column = truncate(x);
    const Ints row = truncate(y);
    const Floats fx = x - toFloats(column);
    const Floats fy = y - toFloats(row);
    const Ints at = row * stride + column;
    const Pair upperDepth = lookUpPair(depths, at);
    const Pair lowerDepth = lookUpPair(depths + stride, at);
    const Pair upper = lookUpPair(colours, at);
    const Pair lower = lookUpPair(colours + stride, at);
    const Floats weights[4] = {(1.0F - fx) * (1.0F - fy), fx * (1.0F - fy), (1.0F - fx) * fy, fx * fy};
    const Ints stored[4] = {upperDepth.first, upperDepth.second, lowerDepth.first, lowerDepth.second};
    const Ints texels[4] = {upper.first, upper.second, lower.first, lower.second};
    Floats red;
    Floats green;
    Floats blue;
    Floats coverage;
    Floats weight;
    for (std::size_t i = 0; i < 4; ++i) {
      const Floats part = onlyWhere(toFloats(stored[i]) >= limit, weights[i]);
      red = mulAdd(part, byteOf<0>(texels[i]), red);
      green = mulAdd(part, byteOf<8>(texels[i]), green);
      blue = mulAdd(part, byteOf<16>(texels[i]), blue);
      coverage = mulAdd(part, byteOf<24>(texels[i]), coverage);
      weight += part;
    }
    sum_.red[g] = mulAdd(red, viewWeight, sum_.red[g]);
    sum_.green[g] = mulAdd(green, viewWeight, sum_.green[g]);
    sum_.blue[g] = mulAdd(blue, viewWeight, sum_.blue[g]);
    sum_.coverage[g] = mulAdd(coverage, viewWeight, sum_.coverage[g]);
    sum_.weight[g] = mulAdd(weight, viewWeight, sum_.weight[g]);
  }

  const LightField& field_;
  const int level_;
  const int lighting_;
  Lenses& lenses_;
  TexelWindow window_;
  Blended sum_;
};

}  // namespace grove::objects::lightfield::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
