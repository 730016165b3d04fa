#include "objects/lightfield/simd/surface_search.h"

#include <algorithm>

namespace grove::objects::lightfield::simd {
namespace {

/// Closer points to a view's eye are not looked for, metres.
constexpr float kLeastViewDepth = 1.0e-3F;
/// How far from a texel's depth a ray may pass and still meet it, in texels' widths there, and in steps of the walk.
constexpr float kThickness = 0.75F;
constexpr float kSlack = 1.25F;
/// A surface is met where it has this share of the bilinear footprint, its outline thus being a smooth one.
constexpr float kEnough = 0.35F;
/// A ray that meets nothing, but is hidden for a larger share of its way, is taken to end behind what hides it.
constexpr float kMostlyHidden = 0.35F;
/// How far beyond the ends of the hidden part the next view looks, in texels.
constexpr float kMargin = 3.0F;

/// A pixel's two heaviest views, as numbers of the lattice's points.
struct Choice {
  Plane<Ints> first;
  Plane<Ints> second;
};

/// Lattice points are numbered row by row of a square that holds the lattice; -1 is none.
class Lattice {
 public:
  explicit Lattice(int n) : n_(n) {}
  [[nodiscard]] int side() const { return 2 * n_ + 1; }
  [[nodiscard]] Ints number(Ints i, Ints j) const {
    const Ints size = magnitude(i) + magnitude(j);
    return size <= n_ ? (j + n_) * side() + (i + n_) : Ints{} - 1;
  }
  [[nodiscard]] ViewSphere::Point point(int number) const { return {number % side() - n_, number / side() - n_}; }

 private:
  static Ints magnitude(Ints value) { return value < 0 ? -value : value; }
  int n_;
};

Choice choose(const Tile& tile, const Lattice& lattice) {
  Choice choice;
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Floats u = tile.u[g];
    const Floats v = tile.v[g];
    const Ints i = floored(u + 0.5F);
    const Ints j = floored(v + 0.5F);
    const Floats du = u - toFloats(i);
    const Floats dv = v - toFloats(j);
    const Ints alongU = lattice.number(i + (du > 0.0F ? Ints{} + 1 : Ints{} - 1), j);
    const Ints alongV = lattice.number(i, j + (dv > 0.0F ? Ints{} + 1 : Ints{} - 1));
    const Ints preferU = absolute(du) > absolute(dv);
    const Ints better = preferU ? alongU : alongV;
    const Ints other = preferU ? alongV : alongU;
    const Ints near = lattice.number(i, j);
    const Ints next = better >= 0 ? better : other;
    // Between two points of the rim the nearest whole numbers may lie beyond it.
    choice.first[g] = near >= 0 ? near : next;
    choice.second[g] = near >= 0 ? next : other;
  }
  return choice;
}

bool anyOf(const Plane<Ints>& mask) {
  Ints seen{};
  for (const Ints& lanes : mask) seen |= lanes;
  return any(seen);
}

/// The part of a ray that is walked, as a view sees it: a line of texels, from place 0 to place 1. A point on it is at
/// the place (1 / its view depth - inverseFrom) * perPlace.
struct Way {
  Floats x, y;         ///< texels at place 0
  Floats byX, byY;     ///< from there to place 1
  Floats inverseFrom;  ///< 1 / view depth at place 0
  Floats inverseBy;    ///< from there to place 1
  Floats perPlace;     ///< 1 / inverseBy
  Floats thickness;    ///< kThickness in places

  Way(const Sight& sight, const Lens& lens, Floats zFrom, Floats zTo, Floats from, Floats to) {
    inverseFrom = 1.0F / zFrom;
    const Floats inverseTo = 1.0F / zTo;
    x = (sight.x0 + from * sight.x1) * inverseFrom + lens.middle;
    y = (sight.y0 + from * sight.y1) * inverseFrom + lens.middle;
    byX = (sight.x0 + to * sight.x1) * inverseTo + lens.middle - x;
    byY = (sight.y0 + to * sight.y1) * inverseTo + lens.middle - y;
    inverseBy = least(inverseTo - inverseFrom, all(-1.0e-9F));
    perPlace = 1.0F / inverseBy;
    thickness = -kThickness * lens.metresPerTexel * inverseFrom * perPlace;
  }

  /// View depth, metres.
  [[nodiscard]] Floats depthAt(Floats place) const {
    return 1.0F / (inverseFrom + clamped(place, all(0.0F), all(1.0F)) * inverseBy);
  }
};

/// What comes of a walk; where, as places of the way.
struct Outcome {
  Ints found{};
  Floats foundAt{};
  Floats hidden{};  ///< share of the way that lies behind something
  Floats hiddenAt{};
  Floats hiddenTo{};
  Floats grazed{};  ///< the largest share of a surface that was not enough
  Floats grazedAt{};
  Floats texel{};  ///< length in places
};

/// Walks from texel to texel along the axis that the way mostly follows; looks at the two beside the way at each.
Outcome walkAlong(const Way& way, const NearnessWindow& window, const TexelBox& box, Ints rays) {
  const float* texels = window.nearness() - window.origin();
  const auto stride = static_cast<float>(window.stride());
  const Floats left = all(static_cast<float>(box.left));
  const Floats right = all(static_cast<float>(box.right));
  const Floats top = all(static_cast<float>(box.top));
  const Floats bottom = all(static_cast<float>(box.bottom));
  const Ints level = absolute(way.byX) >= absolute(way.byY);
  const Floats leastAlong = level ? left : top;
  const Floats mostAlong = level ? right : bottom;
  const Floats leastAcross = level ? top : left;
  const Floats mostAcross = (level ? bottom : right) - 1.0F;
  const Floats alongStride = level ? all(1.0F) : all(stride);
  const Floats acrossStride = level ? all(stride) : all(1.0F);
  const Ints acrossStep = truncated(acrossStride);
  const Floats along0 = level ? way.x : way.y;
  const Floats alongBy = level ? way.byX : way.byY;
  const Floats across0 = level ? way.y : way.x;
  const Floats acrossBy = level ? way.byY : way.byX;
  const Floats sign = alongBy < 0.0F ? all(-1.0F) : all(1.0F);
  const auto reached = [&](Floats along) {
    return clamped(sign * toFloats(floored(sign * along)), leastAlong, mostAlong);
  };
  const Floats first = reached(along0);
  const Floats steps = absolute(reached(along0 + alongBy) - first) + 2.0F;
  const Floats placePerTexel = 1.0F / (sign * most(absolute(alongBy), all(0.5F)));
  const Floats placeOfZero = -way.inverseFrom * way.perPlace;
  Outcome outcome;
  outcome.texel = absolute(placePerTexel);
  const Floats slack = kSlack * outcome.texel + way.thickness;
  const Floats reach = 0.5F + slack;
  // Places times what was met there; divided by what was met when the walk is over.
  Floats foundPlaces{};
  Floats foundMet = all(1.0F);
  Floats grazedPlaces{};
  Floats hiddenSteps{};
  // A surface is met partly at one step and partly at the next one.
  Floats metBefore{};
  Floats placesBefore{};
  Mask walking = maskOf(rays);
  Mask found{};
  const float mostSteps = mostOf(rays ? steps : all(0.0F));
  for (float k = 0.0F; k < mostSteps && any(walking); k += 1.0F) {
    const Floats along = clamped(first + sign * k, leastAlong, mostAlong);
    const Floats here = clamped((along - along0) * placePerTexel, all(0.0F), all(1.0F));
    const Floats across = clamped(across0 + here * acrossBy, leastAcross, mostAcross);
    const Floats line = toFloats(truncated(across));
    const Floats beside = across - line;
    const Ints at = truncated(along * alongStride + line * acrossStride);
    const Floats nearness[2] = {lookUp(texels, at), lookUp(texels, at + acrossStep)};
    const Floats weight[2] = {1.0F - beside, beside};
    const Floats hiding = here - slack;
    Floats met{};
    Floats places{};
    Floats behind{};
    for (std::size_t i = 0; i < 2; ++i) {
      // Where the ray is at this texel's depth, and how much of the texel it meets there.
      const Floats place = nearness[i] * way.perPlace + placeOfZero;
      const Floats awayAlong = absolute(along0 + place * alongBy - along);
      const Floats awayAcross = absolute(across0 + place * acrossBy - line - static_cast<float>(i));
      const Floats share = most(1.0F - awayAlong, all(0.0F)) * most(1.0F - awayAcross, all(0.0F));
      const Floats counted = onlyWhere(isAtMost(absolute(place - 0.5F), reach), share);
      met += counted;
      places += counted * place;
      behind += onlyWhere(isBelow(place, hiding), weight[i]);
    }
    const Floats total = met + metBefore;
    const Floats totalPlaces = places + placesBefore;
    metBefore = met;
    placesBefore = places;
    const Mask ends = walking & isBelow(all(kEnough), total);
    foundPlaces = select(ends, totalPlaces, foundPlaces);
    foundMet = select(ends, total, foundMet);
    found = found | ends;
    walking = walking & ~ends;
    const Mask hides = walking & isBelow(all(0.5F), behind);
    outcome.hiddenAt = select(hides & isBelow(hiddenSteps, all(0.5F)), here, outcome.hiddenAt);
    outcome.hiddenTo = select(hides, here, outcome.hiddenTo);
    hiddenSteps += onlyWhere(hides, all(1.0F));
    const Mask grazes = walking & isBelow(outcome.grazed, total);
    grazedPlaces = select(grazes, totalPlaces, grazedPlaces);
    outcome.grazed = select(grazes, total, outcome.grazed);
    walking = walking & isBelow(all(k + 1.0F), steps);
  }
  outcome.found = lanesOf(found);
  outcome.foundAt = foundPlaces / foundMet;
  outcome.grazedAt = grazedPlaces / most(outcome.grazed, all(1.0e-6F));
  outcome.hidden = hiddenSteps / steps;
  return outcome;
}

}  // namespace

void SurfaceSearch::run(Tile& tile) {
  const Lattice lattice(field_.sphere.subdivision());
  const Choice choice = choose(tile, lattice);
  Plane<Ints> open;
  for (std::size_t g = 0; g < kGroups; ++g) {
    tile.found[g] = Ints{};
    tile.guessed[g] = Ints{};
    tile.depth[g] = all(0.0F);
    open[g] = tile.to[g] > tile.from[g];
  }
  for (const Plane<Ints>* numbers : {&choice.first, &choice.second}) {
    Plane<Ints> left;
    Plane<Ints> mask;
    for (std::size_t g = 0; g < kGroups; ++g) left[g] = open[g] & ((*numbers)[g] >= 0);
    while (anyOf(left)) {
      // The largest number that is left is the next view.
      Ints largest = Ints{} - 1;
      for (std::size_t g = 0; g < kGroups; ++g) {
        const Ints number = left[g] ? (*numbers)[g] : Ints{} - 1;
        largest = number > largest ? number : largest;
      }
      std::int32_t number = -1;
      for (int lane = 0; lane < kLanes; ++lane) number = std::max(number, largest[lane]);
      for (std::size_t g = 0; g < kGroups; ++g) {
        const Ints here = (*numbers)[g] == number;
        mask[g] = left[g] & here;
        left[g] &= ~here;
        open[g] &= ~mask[g];
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

void SurfaceSearch::walk(Tile& tile, int view, Plane<Ints>& mask) {
  const Lens& lens = lenses_.of(view);
  const float last = static_cast<float>((field_.size >> level_) - 2);
  Extent across;
  Extent down;
  for (std::size_t g = 0; g < kGroups; ++g) {
    if (!any(mask[g])) continue;
    const Sight sight(tile, static_cast<int>(g), lens);
    for (const Floats t : {tile.from[g], tile.to[g]}) {
      const Floats inverse = 1.0F / most(sight.z0 + t * sight.z1, all(kLeastViewDepth));
      across.add(clamped((sight.x0 + t * sight.x1) * inverse + lens.middle, all(0.0F), all(last)), mask[g]);
      down.add(clamped((sight.y0 + t * sight.y1) * inverse + lens.middle, all(0.0F), all(last)), mask[g]);
    }
  }
  const TexelBox box{static_cast<int>(across.low()), static_cast<int>(down.low()), static_cast<int>(across.high()) + 1,
                     static_cast<int>(down.high()) + 1};
  if (!window_.load(field_, level_, lens, box)) {
    mask = {};
    return;
  }

  const float low = window_.nearest();
  const float high = window_.farthest();
  const float slack = kThickness * lens.metresPerTexel * high;
  for (std::size_t g = 0; g < kGroups; ++g) {
    if (!any(mask[g])) continue;
    const Sight sight(tile, static_cast<int>(g), lens);
    const Floats perDepth = 1.0F / most(sight.z1, all(1.0e-6F));
    const Floats from = most(tile.from[g], (low - slack - sight.z0) * perDepth);
    const Floats to = least(tile.to[g], (high + slack - sight.z0) * perDepth);
    const Floats zFrom = most(sight.z0 + from * sight.z1, all(kLeastViewDepth));
    const Floats zTo = most(sight.z0 + to * sight.z1, all(kLeastViewDepth));
    const Way way(sight, lens, zFrom, zTo, from, to);
    const Outcome outcome = walkAlong(way, window_, box, mask[g] & (zTo > zFrom));

    const Ints nothing = mask[g] & ~outcome.found;
    const Ints hidden = nothing & (outcome.hidden > 0.0F);
    // A ray that begins behind all that this view sees is hidden from it, too.
    const Ints open = hidden | (nothing & (tile.from[g] > to));
    const Ints grazes = nothing & (outcome.grazed > 0.0F);
    const Ints settled = outcome.found | (grazes & ~open);
    const Ints guesses = open & (grazes | (outcome.hidden > kMostlyHidden)) & ~tile.guessed[g];
    const Floats place = outcome.found ? outcome.foundAt
                         : grazes      ? outcome.grazedAt
                                       : 0.5F * (outcome.hiddenAt + outcome.hiddenTo);
    const auto rayDepth = [&](Floats at) {
      return clamped((way.depthAt(at) - sight.z0) * perDepth, tile.from[g], tile.to[g]);
    };
    tile.depth[g] = settled | guesses ? rayDepth(place) : tile.depth[g];
    tile.found[g] |= settled;
    tile.guessed[g] |= guesses;
    // Elsewhere on its way the ray is seen to meet nothing.
    const Floats nextFrom = rayDepth(outcome.hiddenAt - kMargin * outcome.texel);
    const Floats nextTo = rayDepth(outcome.hiddenTo + kMargin * outcome.texel);
    tile.from[g] = hidden ? nextFrom : tile.from[g];
    tile.to[g] = hidden ? nextTo : tile.to[g];
    mask[g] = open;
  }
}

}  // namespace grove::objects::lightfield::simd
