// Finds the surface point of each pixel. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_SURFACE_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_SURFACE_SEARCH_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_SURFACE_SEARCH_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_SURFACE_SEARCH_INL_H
#endif

#include <hwy/highway.h>

#include "objects/lightfield/backend/simd/ray_march_inl.h"
#include "objects/lightfield/backend/simd/texel_window_inl.h"
#include "objects/lightfield/backend/simd/tile_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::simd::HWY_NAMESPACE {

/// A pixel's two heaviest views, as numbers of lattice points.
struct Choice {
  Plane<Ints> first;
  Plane<Ints> second;
};

/// Lattice points are numbered row by row in a square that encloses the lattice; -1 is none.
class Lattice {
 public:
  explicit Lattice(int n) : n_(n) {}
  [[nodiscard]] int side() const { return 2 * n_ + 1; }
  [[nodiscard]] Ints number(Ints i, Ints j) const {
    return select(magnitude(i) + magnitude(j) > n_, -1, (j + n_) * side() + (i + n_));
  }
  [[nodiscard]] ViewSphere::Point point(int number) const { return {number % side() - n_, number / side() - n_}; }

 private:
  static Ints magnitude(Ints value) { return max(value, Ints() - value); }
  int n_;
};

/// Beyond every lattice.
constexpr float kFarOut = 1.0e6F;

inline Choice choose(const Tile& tile, const Lattice& lattice) {
  Choice choice;
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Floats u = tile.u[g];
    const Floats v = tile.v[g];
    // Rays without a hit may have infinite coordinates.
    const Ints i = floorToInts(clamp(u + 0.5F, -kFarOut, kFarOut));
    const Ints j = floorToInts(clamp(v + 0.5F, -kFarOut, kFarOut));
    const Floats du = u - toFloats(i);
    const Floats dv = v - toFloats(j);
    const Ints alongU = lattice.number(i + select(du > 0.0F, Ints(1), Ints(-1)), j);
    const Ints alongV = lattice.number(i, j + select(dv > 0.0F, Ints(1), Ints(-1)));
    const Mask preferU = abs(du) > abs(dv);
    const Ints better = select(preferU, alongU, alongV);
    const Ints other = select(preferU, alongV, alongU);
    const Ints near = lattice.number(i, j);
    const Ints next = select(better > -1, better, other);
    // Between two points of the rim, the nearest whole numbers may lie beyond it.
    choice.first[g] = select(near > -1, near, next);
    choice.second[g] = select(near > -1, next, other);
  }
  return choice;
}

inline bool anyOf(const Plane<Mask>& mask) {
  Mask seen;
  for (const Mask& lanes : mask) seen |= lanes;
  return any(seen);
}

/// Finds the object's point for each pixel by marching along its ray in a nearby view.
class SurfaceSearch {
 public:
  SurfaceSearch(const LightField& field, int level, Lenses& lenses) : field_(field), level_(level), lenses_(lenses) {}

  /// Fills the tile's depth and found.
  void run(Tile& tile) {
    const Lattice lattice(field_.sphere.subdivision());
    const Choice choice = choose(tile, lattice);
    Plane<Mask> open;
    for (std::size_t g = 0; g < kGroups; ++g) {
      tile.found[g] = Mask();
      tile.guessed[g] = Mask();
      tile.depth[g] = Floats();
      open[g] = tile.to[g] > tile.from[g];
    }
    for (const Plane<Ints>* numbers : {&choice.first, &choice.second}) {
      Plane<Mask> left;
      Plane<Mask> mask;
      for (std::size_t g = 0; g < kGroups; ++g) left[g] = open[g] & ((*numbers)[g] > -1);
      while (anyOf(left)) {
        // The largest remaining number is the next view.
        Ints largest = -1;
        for (std::size_t g = 0; g < kGroups; ++g) largest = max(largest, select(left[g], (*numbers)[g], Ints(-1)));
        const std::int32_t number = maxOf(largest);
        for (std::size_t g = 0; g < kGroups; ++g) {
          const Mask here = (*numbers)[g] == number;
          mask[g] = left[g] & here;
          left[g] = without(left[g], here);
          open[g] = without(open[g], mask[g]);
        }
        walk(tile, field_.sphere.view(lattice.point(number)), mask);
        for (std::size_t g = 0; g < kGroups; ++g) open[g] |= mask[g];
      }
    }
    for (std::size_t g = 0; g < kGroups; ++g) {
      tile.guessed[g] &= open[g];
      tile.found[g] |= tile.guessed[g];
    }
  }

 private:
  /// Points closer to a view's eye are ignored, metres.
  static constexpr float kMinViewDepth = 1.0e-3F;
  /// A ray without a hit that is hidden for a larger share of its way ends behind the texels that hide it.
  static constexpr float kMostlyHidden = 0.35F;
  /// Texels that the next view searches beyond both ends of the hidden part.
  static constexpr float kMargin = 3.0F;

  /// The texels of a view that the masked rays can hit.
  [[nodiscard]] TexelBox boxOf(const Tile& tile, const Lens& lens, const Plane<Mask>& mask) const {
    const auto last = static_cast<float>((field_.size >> level_) - 2);
    Extent across;
    Extent down;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (!any(mask[g])) continue;
      const Sight sight(tile, static_cast<int>(g), lens);
      for (const Floats& t : {tile.from[g], tile.to[g]}) {
        const Floats inverse = 1.0F / max(sight.z0 + t * sight.z1, kMinViewDepth);
        across.add(clamp((sight.x0 + t * sight.x1) * inverse + lens.middle, 0.0F, last), mask[g]);
        down.add(clamp((sight.y0 + t * sight.y1) * inverse + lens.middle, 0.0F, last), mask[g]);
      }
    }
    return {static_cast<int>(across.low()), static_cast<int>(down.low()), static_cast<int>(across.high()) + 1,
            static_cast<int>(down.high()) + 1};
  }

  /// Marches the masked pixels in `view`. Removes pixels with a hit or a certain miss from the mask; the rest are rays
  /// that passed behind something.
  void walk(Tile& tile, int view, Plane<Mask>& mask) {
    const Lens& lens = lenses_.of(view);
    const TexelBox box = boxOf(tile, lens, mask);
    if (!loadWindow(field_, level_, lens, box, window_)) {
      mask = {};
      return;
    }
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (any(mask[g])) mask[g] = walkGroup(tile, g, lens, box, mask[g]);
    }
  }

  /// The same for one group; returns the remaining mask.
  [[nodiscard]] Mask walkGroup(Tile& tile, std::size_t g, const Lens& lens, const TexelBox& box, Mask mask) {
    const float low = window_.nearest;
    const float high = window_.farthest;
    const float slack = kThickness * lens.metresPerTexel * high;
    const Sight sight(tile, static_cast<int>(g), lens);
    const Floats perDepth = 1.0F / max(sight.z1, 1.0e-6F);
    const Floats from = max(tile.from[g], (low - slack - sight.z0) * perDepth);
    const Floats to = min(tile.to[g], (high + slack - sight.z0) * perDepth);
    const Floats zFrom = max(sight.z0 + from * sight.z1, kMinViewDepth);
    const Floats zTo = max(sight.z0 + to * sight.z1, kMinViewDepth);
    const RaySegment segment(sight, lens, zFrom, zTo, from, to);
    const MarchResult march = marchAlong(segment, window_, box, mask & (zTo > zFrom));

    const Mask nothing = without(mask, march.found);
    const Mask hidden = nothing & (march.hidden > 0.0F);
    // A ray that begins behind everything that this view sees is also hidden from it.
    const Mask open = hidden | (nothing & (tile.from[g] > to));
    const Mask grazes = nothing & (march.grazed > 0.0F);
    const Mask settled = march.found | without(grazes, open);
    const Mask guesses = without(open & (grazes | (march.hidden > kMostlyHidden)), tile.guessed[g]);
    const Floats place =
        select(march.found, march.foundAt, select(grazes, march.grazedAt, 0.5F * (march.hiddenAt + march.hiddenTo)));
    const auto rayDepth = [&](Floats at) {
      return clamp((segment.depthAt(at) - sight.z0) * perDepth, tile.from[g], tile.to[g]);
    };
    tile.depth[g] = select(settled | guesses, rayDepth(place), tile.depth[g]);
    tile.found[g] |= settled;
    tile.guessed[g] |= guesses;
    // The rest of its way certainly has no hit.
    const Floats nextFrom = rayDepth(march.hiddenAt - kMargin * march.texel);
    const Floats nextTo = rayDepth(march.hiddenTo + kMargin * march.texel);
    tile.from[g] = select(hidden, nextFrom, tile.from[g]);
    tile.to[g] = select(hidden, nextTo, tile.to[g]);
    return open;
  }

  const LightField& field_;
  const int level_;
  Lenses& lenses_;
  NearnessWindow window_;
};

}  // namespace grove::objects::lightfield::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
