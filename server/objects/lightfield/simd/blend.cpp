#include "objects/lightfield/simd/blend.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace grove::objects::lightfield::simd {
namespace {

/// A texel hides a pixel's point if it is nearer by more, in texels' widths there.
constexpr float kAgreement = 7.0F;
constexpr float kLeastViewDepth = 1.0e-3F;

inline Floats byteOf(Ints texel, int shift) { return toFloats((texel >> shift) & 0xFF); }

}  // namespace

const Blended& Blend::run(const Tile& tile) {
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

void Blend::add(const Tile& tile, ViewSphere::Point point) {
  Plane<Floats> viewWeight;
  Ints anyWeight{};
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Floats u = most(1.0F - absolute(tile.u[g] - static_cast<float>(point.i)), all(0.0F));
    const Floats v = most(1.0F - absolute(tile.v[g] - static_cast<float>(point.j)), all(0.0F));
    viewWeight[g] = tile.found[g] ? u * v : all(0.0F);
    anyWeight |= viewWeight[g] > 0.0F;
  }
  if (!any(anyWeight)) return;

  const int view = field_.sphere.view(point);
  const Lens& lens = lenses_.of(view);
  const float last = static_cast<float>((field_.size >> level_) - 2);
  Plane<Floats> across;
  Plane<Floats> down;
  Plane<Floats> away;
  Extent columns;
  Extent rows;
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Ints mask = viewWeight[g] > 0.0F;
    if (!any(mask)) continue;
    const Sight sight(tile, static_cast<int>(g), lens);
    const Floats t = tile.depth[g];
    away[g] = sight.z0 + t * sight.z1;
    const Floats inverse = 1.0F / most(away[g], all(kLeastViewDepth));
    across[g] = clamped((sight.x0 + t * sight.x1) * inverse + lens.middle, all(0.0F), all(last));
    down[g] = clamped((sight.y0 + t * sight.y1) * inverse + lens.middle, all(0.0F), all(last));
    columns.add(across[g], mask);
    rows.add(down[g], mask);
  }
  const TexelBox box{static_cast<int>(columns.low()), static_cast<int>(rows.low()),
                     static_cast<int>(columns.high()) + 1, static_cast<int>(rows.high()) + 1};
  window_.load(field_, level_, view, lighting_, box);

  const std::uint16_t* depths = window_.depth() - window_.origin();
  const std::uint32_t* colours = window_.colour() - window_.origin();
  const int stride = window_.stride();
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Ints mask = viewWeight[g] > 0.0F;
    if (!any(mask)) continue;
    // Pixels that do not take part have no place in the view.
    const Floats x = mask ? across[g] : all(static_cast<float>(box.left));
    const Floats y = mask ? down[g] : all(static_cast<float>(box.top));
    const Ints column = truncated(x);
    const Ints row = truncated(y);
    const Floats fx = x - toFloats(column);
    const Floats fy = y - toFloats(row);
    const Ints at = row * stride + column;
    const Pair upperDepth = lookUpPair(depths, at);
    const Pair lowerDepth = lookUpPair(depths, at + stride);
    const Pair upper = lookUpPair(colours, at);
    const Pair lower = lookUpPair(colours, at + stride);
    const Floats weights[4] = {(1.0F - fx) * (1.0F - fy), fx * (1.0F - fy), (1.0F - fx) * fy, fx * fy};
    const Ints stored[4] = {upperDepth.first, upperDepth.second, lowerDepth.first, lowerDepth.second};
    const Ints texels[4] = {upper.first, upper.second, lower.first, lower.second};

    // Nearer texels hide the point; farther ones and empty ones are what shows beside it.
    const Floats nearest =
        (away[g] - kAgreement * lens.metresPerTexel * away[g] - lens.nearDepth) * (1.0F / lens.depthStep);
    const Floats limit = tile.guessed[g] ? all(0.0F) : nearest;
    Floats red{};
    Floats green{};
    Floats blue{};
    Floats coverage{};
    Floats weight{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Floats part = toFloats(stored[i]) >= limit ? weights[i] : all(0.0F);
      red += part * byteOf(texels[i], 0);
      green += part * byteOf(texels[i], 8);
      blue += part * byteOf(texels[i], 16);
      coverage += part * byteOf(texels[i], 24);
      weight += part;
    }
    sum_.red[g] += red * viewWeight[g];
    sum_.green[g] += green * viewWeight[g];
    sum_.blue[g] += blue * viewWeight[g];
    sum_.coverage[g] += coverage * viewWeight[g];
    sum_.weight[g] += weight * viewWeight[g];
  }
}

}  // namespace grove::objects::lightfield::simd
