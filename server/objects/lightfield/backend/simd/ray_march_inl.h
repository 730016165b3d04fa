// Marches along rays in a view's texels. For kernels: included once per target.

#if defined(GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_WALK_INL_H
#undef GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_WALK_INL_H
#else
#define GROVE_OBJECTS_LIGHTFIELD_BACKEND_SIMD_WALK_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/look_up_inl.h"
#include "objects/lightfield/backend/simd/texel_window.h"
#include "objects/lightfield/backend/simd/tile_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::simd::HWY_NAMESPACE {

/// Largest distance between a ray and a texel's depth for a hit, in widths of a texel there and in steps of the march.
constexpr float kThickness = 0.75F;
constexpr float kSlack = 1.25F;
/// A surface is hit where it covers this share of the bilinear footprint, which makes its outline smooth.
constexpr float kEnough = 0.35F;

/// The marched part of a ray as a line of texels in the view, from place 0 to place 1. A point on it has the place (1 /
/// its view depth - inverseFrom) * perPlace.
struct RaySegment {
  Floats x, y;         ///< texel coordinates at place 0
  Floats byX, byY;     ///< difference to place 1
  Floats inverseFrom;  ///< 1 / view depth at place 0
  Floats inverseBy;    ///< difference to place 1
  Floats perPlace;     ///< 1 / inverseBy
  Floats thickness;    ///< kThickness in places

  RaySegment(const Sight& sight, const Lens& lens, Floats zFrom, Floats zTo, Floats from, Floats to) {
    inverseFrom = 1.0F / zFrom;
    const Floats inverseTo = 1.0F / zTo;
    x = (sight.x0 + from * sight.x1) * inverseFrom + lens.middle;
    y = (sight.y0 + from * sight.y1) * inverseFrom + lens.middle;
    byX = (sight.x0 + to * sight.x1) * inverseTo + lens.middle - x;
    byY = (sight.y0 + to * sight.y1) * inverseTo + lens.middle - y;
    inverseBy = min(inverseTo - inverseFrom, -1.0e-9F);
    perPlace = 1.0F / inverseBy;
    thickness = -kThickness * lens.metresPerTexel * inverseFrom * perPlace;
  }

  /// View depth, metres.
  [[nodiscard]] Floats depthAt(Floats place) const {
    return 1.0F / (inverseFrom + clamp(place, 0.0F, 1.0F) * inverseBy);
  }
};

/// The result of a march; positions are places of the segment.
struct MarchResult {
  Mask found;
  Floats foundAt;
  Floats hidden;  ///< share of the segment behind other texels
  Floats hiddenAt;
  Floats hiddenTo;
  Floats grazed;  ///< largest share of a surface below the threshold
  Floats grazedAt;
  Floats texel;  ///< length of a texel in places
};

/// A segment as a march over the lines of texels that it crosses: along the dominant axis, one step per line.
struct Walk {
  Floats minAlong;
  Floats maxAlong;
  Floats minAcross;
  Floats maxAcross;
  Floats alongStride;
  Floats acrossStride;
  Ints acrossStep;
  Floats along0;
  Floats alongBy;
  Floats across0;
  Floats acrossBy;
  Floats sign;  ///< direction of a step
  Floats first;
  Floats steps;
  Floats placePerTexel;
};

HWY_INLINE Walk walkOf(const RaySegment& segment, float stride, const TexelBox& box) {
  const Floats left = static_cast<float>(box.left);
  const Floats right = static_cast<float>(box.right);
  const Floats top = static_cast<float>(box.top);
  const Floats bottom = static_cast<float>(box.bottom);
  const Mask level = abs(segment.byX) >= abs(segment.byY);
  Walk walk;
  walk.minAlong = select(level, left, top);
  walk.maxAlong = select(level, right, bottom);
  walk.minAcross = select(level, top, left);
  walk.maxAcross = select(level, bottom, right) - 1.0F;
  walk.alongStride = select(level, Floats(1.0F), Floats(stride));
  walk.acrossStride = select(level, Floats(stride), Floats(1.0F));
  walk.acrossStep = truncate(walk.acrossStride);
  walk.along0 = select(level, segment.x, segment.y);
  walk.alongBy = select(level, segment.byX, segment.byY);
  walk.across0 = select(level, segment.y, segment.x);
  walk.acrossBy = select(level, segment.byY, segment.byX);
  walk.sign = select(walk.alongBy < 0.0F, Floats(-1.0F), Floats(1.0F));
  const auto reached = [&](Floats along) {
    return clamp(walk.sign * floor(walk.sign * along), walk.minAlong, walk.maxAlong);
  };
  walk.first = reached(walk.along0);
  walk.steps = abs(reached(walk.along0 + walk.alongBy) - walk.first) + 2.0F;
  walk.placePerTexel = 1.0F / (walk.sign * max(abs(walk.alongBy), 0.5F));
  return walk;
}

/// What a ray meets of the two texels beside its place on a line.
struct Meeting {
  Floats here;    ///< place of the segment
  Floats met;     ///< sum of the texels' shares
  Floats places;  ///< sum of their places, weighted by the shares
  Floats behind;  ///< share of the place that lies behind them
};

HWY_INLINE Meeting meetLine(const RaySegment& segment, const Walk& walk, const float* texels, Floats slack, float k) {
  const Floats placeOfZero = -segment.inverseFrom * segment.perPlace;
  const Floats reach = 0.5F + slack;
  const Floats along = clamp(walk.first + walk.sign * k, walk.minAlong, walk.maxAlong);
  Meeting meeting;
  meeting.here = clamp((along - walk.along0) * walk.placePerTexel, 0.0F, 1.0F);
  const Floats across = clamp(walk.across0 + meeting.here * walk.acrossBy, walk.minAcross, walk.maxAcross);
  const Floats line = toFloats(truncate(across));
  const Floats beside = across - line;
  const Ints at = truncate(along * walk.alongStride + line * walk.acrossStride);
  const Floats nearness[2] = {lookUp(texels, at), lookUp(texels, at + walk.acrossStep)};
  const Floats weight[2] = {1.0F - beside, beside};
  const Floats hiding = meeting.here - slack;
  for (std::size_t i = 0; i < 2; ++i) {
    // The place where the ray is at this texel's depth, and the texel's weight there.
    const Floats place = mulAdd(nearness[i], segment.perPlace, placeOfZero);
    const Floats awayAlong = abs(mulAdd(place, walk.alongBy, walk.along0 - along));
    const Floats awayAcross = abs(mulAdd(place, walk.acrossBy, walk.across0 - line - static_cast<float>(i)));
    const Floats share = max(1.0F - awayAlong, 0.0F) * max(1.0F - awayAcross, 0.0F);
    const Floats counted = onlyWhere(abs(place - 0.5F) <= reach, share);
    meeting.met += counted;
    meeting.places = mulAdd(counted, place, meeting.places);
    meeting.behind += onlyWhere(place < hiding, weight[i]);
  }
  return meeting;
}

inline MarchResult marchAlong(const RaySegment& segment, const NearnessWindow& window, const TexelBox& box, Mask rays) {
  const float* const texels = window.nearness.data() - window.layout.origin;
  const Walk walk = walkOf(segment, static_cast<float>(window.layout.stride), box);
  MarchResult march;
  march.texel = abs(walk.placePerTexel);
  const Floats slack = kSlack * march.texel + segment.thickness;
  // Sum of places weighted by coverage; divided by the coverage after the march.
  Floats foundPlaces;
  Floats foundMet = 1.0F;
  Floats grazedPlaces;
  Floats hiddenSteps;
  // A surface's coverage is split between one step and the next.
  Floats metBefore;
  Floats placesBefore;
  Mask walking = rays;
  Mask found;
  const float maxSteps = maxOf(onlyWhere(rays, walk.steps));
  for (float k = 0.0F; k < maxSteps && any(walking); k += 1.0F) {
    const Meeting meeting = meetLine(segment, walk, texels, slack, k);
    const Floats total = meeting.met + metBefore;
    const Floats totalPlaces = meeting.places + placesBefore;
    metBefore = meeting.met;
    placesBefore = meeting.places;
    const Mask ends = walking & (total > kEnough);
    foundPlaces = select(ends, totalPlaces, foundPlaces);
    foundMet = select(ends, total, foundMet);
    found |= ends;
    walking = without(walking, ends);
    const Mask hides = walking & (meeting.behind > 0.5F);
    march.hiddenAt = select(hides & (hiddenSteps < 0.5F), meeting.here, march.hiddenAt);
    march.hiddenTo = select(hides, meeting.here, march.hiddenTo);
    hiddenSteps += onlyWhere(hides, Floats(1.0F));
    const Mask grazes = walking & (total > march.grazed);
    grazedPlaces = select(grazes, totalPlaces, grazedPlaces);
    march.grazed = select(grazes, total, march.grazed);
    walking &= walk.steps > k + 1.0F;
  }
  march.found = found;
  march.foundAt = foundPlaces / foundMet;
  march.grazedAt = grazedPlaces / max(march.grazed, 1.0e-6F);
  march.hidden = hiddenSteps / walk.steps;
  return march;
}

}  // namespace grove::objects::lightfield::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
